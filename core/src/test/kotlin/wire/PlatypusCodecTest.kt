package stillwater.wire

import org.junit.jupiter.api.Test
import stillwater.model.LatLon
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

class PlatypusCodecTest {
    private val messages = mutableListOf<Message>()
    private val codec = PlatypusCodec { messages += it }

    private fun read(line: String): List<Message> {
        messages.clear()
        val bytes = line.toByteArray(Charsets.ISO_8859_1)
        codec.line(bytes, 0, bytes.size)
        return messages.toList()
    }

    @Test
    fun bothFirmwareGenerationsGiveMotors() {
        assertEquals(
            listOf(Message.Motor(0, 0.3, 0.0), Message.Motor(1, -0.5, 1.25)),
            read("""{"m0":{"v":0.300000,"c":0.000000},"m1":{"v":-0.500000,"c":1.250000}}"""),
        )
        assertEquals(
            listOf(Message.Motor(0, 1.0, Double.NaN), Message.Motor(1, 0.0, Double.NaN)),
            read("""{ "m0" : {"v": 1}, "m1":{"v":0}}"""),
        )
        assertEquals(0, codec.malformed.total)
    }

    @Test
    fun everySensorIsRead() {
        val cases = listOf(
            """{"s4":{"type":"battery","data":"15.263 0.000000 0.000000"}}""" to Message.Battery(4, 15.263),
            """{"s1":{"type":"atlas_do","data":"10.15"}}""" to Message.Oxygen(1, 10.15),
            """{"s1":{"data":"7.78,91.2","type":"atlas_do"}}""" to Message.Oxygen(1, 7.78),
            """{"s2":{"type":"atlas_ph","data":"7.054"}}""" to Message.Acidity(2, 7.054),
            """{"s3":{"type":"es2","data":"249 19.4"}}""" to Message.Conductivity(3, 249.0, 19.4),
            """{"s2":{"type":"winch","depth":1.5}}""" to Message.Winch(2, 1.5),
            """{"s3":{"type":"imu","data":"271.5,3,2,1,0"}}""" to Message.Imu(3, 271.5, 3, 2, 1, 0),
            """{"s3":{"type":"hds","data":"${'$'}SDDBT,8.1,f,2.4,M,1.3,F*0B"}}""" to Message.Depth(3, 2.4),
            """{"s3":{"type":"hds","data":"${'$'}SDMTW,19.4,C"}}""" to Message.WaterTemperature(3, 19.4),
            """{"s3":{"type":"turbidity","data":"1 2.5"}}""" to Message.Other(3, "turbidity", listOf(1.0, 2.5)),
            """{"s0":{"p":-0.2}}""" to Message.Servo(0, -0.2),
            """{"e":{"type":"state","data":"active"}}""" to Message.State(BoardState.ACTIVE),
            "STATE: CONNECTED" to Message.State(BoardState.CONNECTED),
            "Arming motor 0..." to Message.Notice("Arming motor 0..."),
        )
        for ((line, message) in cases) assertEquals(listOf(message), read(line), line)
        assertEquals(0, codec.malformed.total, codec.malformed.toString())
    }

    @Test
    fun aFixIsReadAndItsChecksumTested() {
        // The sentence of the NMEA 0183 handbook: 48 deg 07.038 min N, 11 deg 31.000 min E, 22.4 knots.
        val body = "GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W"
        val fix = assertIs<Message.Fix>(read("""{"s1":{"type":"gps","data":"${'$'}$body*6A"}}""").single())
        assertEquals(LatLon(48 + 7.038 / 60, 11 + 31.0 / 60), fix.place)
        assertEquals(22.4 * 1852 / 3600, fix.speed, 1e-12) // rounding of one product
        assertEquals(emptyList(), read("""{"s1":{"type":"gps","data":"${'$'}$body*6B"}}"""))
        assertEquals(1, codec.malformed[Malformed.CHECKSUM])
        val none = read("""{"s1":{"type":"gps","data":"${'$'}GPRMC,123519,V,,,,,,,230394,,"}}""").single()
        assertEquals(null, (none as Message.Fix).place)
    }

    /** A receiver that goes on by dead reckoning, or was told where it is, has no fix: the mission is to see it grow old. */
    @Test
    fun aPlaceThatWasNotMeasuredIsNoFix() {
        fun place(sentence: String) =
            (read("""{"s1":{"type":"gps","data":"${'$'}$sentence"}}""").single() as Message.Fix).place
        val there = LatLon(48 + 7.038 / 60, 11 + 31.0 / 60)
        for (quality in 0..9) {
            val expected = there.takeIf { quality in setOf(1, 2, 3, 4, 5, 9) }
            val found = place("GPGGA,123519,4807.038,N,01131.000,E,$quality,08,0.9,545.4,M,46.9,M,,")
            assertEquals(expected, found, "quality $quality")
        }
        for (mode in listOf("", ",A", ",D", ",F", ",P", ",R", ",E", ",M", ",S", ",N")) {
            val expected = there.takeIf { mode.takeLast(1) !in setOf("E", "M", "S", "N") }
            val found = place("GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W$mode")
            assertEquals(expected, found, "mode $mode")
        }
        assertEquals(0, codec.malformed.total)
    }

    @Test
    fun errorsEchoWhatTheyGotAndNothingInThemIsRead() {
        assertEquals(
            listOf(Message.Refused(BoardError.TARGET, """{"m0":{"v":1}}""")),
            read("""{"error": "Unknown command target.","args": "{"m0":{"v":1}}"}"""),
        )
        assertEquals(
            listOf(Message.Refused(BoardError.JSON, """{"m0":{"v":0.3},"m1""")),
            read("""{"error": "Failed to parse JSON command.","args": "{"m0":{"v":0.3},"m1"}"""),
        )
        assertEquals(BoardError.UNKNOWN, (read("""{"error":"New words","args":""}""").single() as Message.Refused).kind)
        assertEquals(0, codec.malformed.total)
    }

    /** Whichever byte of an error is spoilt, the drive that it echoes is not what motors get. */
    @Test
    fun aDriveInTheEchoOfASpoiltErrorIsNoMotorLine() {
        val echoed = "{\"m0\":{\"v\":0.3},\"m\u00d6\":{\"v\":0.5}}"
        val line = "{\"error\": \"Unknown command target.\",\"args\": \"$echoed\"}"
        for (at in line.indices) {
            // A brace is what reading begins at.
            for (byte in listOf('x', '"', '{', '}', '\u0081')) {
                val spoilt = line.replaceRange(at, at + 1, byte.toString())
                assertEquals(emptyList(), read(spoilt).filterIsInstance<Message.Motor>(), spoilt)
            }
        }
        assertEquals(emptyList(), read("x\"args\": \"{\"m0\":{\"v\":0.3},\"m1\":{\"v\":0.5}}\"}"))
    }

    /** An error that begins anywhere, as behind a byte that became a line's end or where a link comes back. */
    @Test
    fun aDriveInTheRestOfAnErrorIsNoMotorLine() {
        val oxygen = "{\"s1\":{\"type\":\"atlas_do\",\"data\":\"10.15\"}}"
        for (last in listOf("m1", "m\u00d6")) {
            val echoed = "{\"m0\":{\"v\":0.3},\"$last\":{\"v\":0.5}}"
            val line = "{\"error\": \"Unknown command target.\",\"args\": \"$echoed\"}"
            messages.clear()
            val framer = LineFramer(codec)
            for (at in line.indices) {
                val spoilt = line.toByteArray(Charsets.ISO_8859_1).also { it[at] = '\n'.code.toByte() }
                framer.accept(spoilt + "\r\n".toByteArray())
                framer.accept((line.substring(at) + "\r\n").toByteArray(Charsets.ISO_8859_1))
                framer.accept((line.substring(at) + oxygen + "\r\n").toByteArray(Charsets.ISO_8859_1))
            }
            assertEquals(emptyList(), messages.filterIsInstance<Message.Motor>())
            framer.accept("{\"m0\":{\"v\":0.3}}  \r\n".toByteArray())
            assertEquals(Message.Motor(0, 0.3, Double.NaN), messages.last())
        }
    }

    @Test
    fun motorsAreReadBehindALineThatLostItsEnd() {
        val motors = "{\"m0\":{\"v\":0.3},\"m1\":{\"v\":0.5}}"
        for (between in listOf("", "\r", "\r\u0081", "     ")) {
            assertEquals(4, read(motors + between + motors).size, between)
        }
        assertEquals(2, read("   $motors").size)
    }

    @Test
    fun anObjectIsTakenWholeOrNotAtAll() {
        val line = """{"m0":{"v":0.3,"c":0.0},"m1":{"v":0.5,"c":0.0}}"""
        for (length in 1 until line.length) assertEquals(emptyList(), read(line.substring(0, length)), "$length bytes")
        assertEquals((line.length - 1).toLong(), codec.malformed[Malformed.SYNTAX])
    }

    @Test
    fun aLostTerminatorCostsNothing() {
        val oxygen = """{"s1":{"type":"atlas_do","data":"10.15"}}"""
        assertEquals(listOf(Message.Oxygen(1, 10.15), Message.Oxygen(1, 10.15)), read(oxygen + oxygen))
        assertEquals(0, codec.malformed.total)
        assertEquals(listOf(Message.Oxygen(1, 10.15)), read("""{"s4":{"type":"batt$oxygen"""))
        assertEquals(listOf(Message.Oxygen(1, 10.15)), read("\u0000\u0081$oxygen"))
        assertEquals(1, codec.malformed[Malformed.SYNTAX])
        assertEquals(1, codec.malformed[Malformed.BINARY])
    }

    @Test
    fun whatCannotBeReadIsCountedByKind() {
        val cases = mapOf(
            """{"s1":{"type":"atlas_do","data":"nan"}}""" to Malformed.BAD_VALUE,
            """{"s1":{"type":"atlas_do","data":"10.1x"}}""" to Malformed.BAD_VALUE,
            """{"s1":{"type":"atlas_do","data":""}}""" to Malformed.BAD_VALUE,
            """{"s1":{"type":"atlas_do"}}""" to Malformed.BAD_VALUE,
            """{"s3":{"type":"es2","data":"249"}}""" to Malformed.BAD_VALUE,
            """{"s1":{"type":"atlas_ph","data":"1e999"}}""" to Malformed.BAD_VALUE,
            """{"m0":{"v":nan}}""" to Malformed.BAD_VALUE,
            """{"z1":{"v":1}}""" to Malformed.UNKNOWN_TARGET,
            """{"m0":{"v":0.3}""" to Malformed.SYNTAX,
            """"data":"10.15"}}""" to Malformed.SYNTAX,
            "\u0007\u0093" to Malformed.BINARY,
        )
        for ((line, kind) in cases) {
            val before = codec.malformed[kind]
            assertTrue(read(line).isEmpty(), line)
            assertEquals(before + 1, codec.malformed[kind], line)
        }
        assertEquals(cases.size.toLong(), codec.malformed.total)
    }
}
