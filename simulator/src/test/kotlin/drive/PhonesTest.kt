package stillwater.drive

import org.junit.jupiter.api.Test
import stillwater.link.BoardWire
import stillwater.link.PhoneReport
import stillwater.link.ReconnectingWire
import stillwater.link.WireProblem
import stillwater.wire.ByteLink
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Where time, fixes and heading come from: the board itself, or a virtual boat's phone. */
class PhonesTest {
    /** A wire on which is read what [says], in that order, and then nothing, or that it is lost. */
    private class Scripted(private vararg val says: String, private val isLostAfterwards: Boolean = false) : BoardWire {
        val written = StringBuilder()
        private var next = 0

        override fun read(into: ByteArray): Int {
            if (next == says.size) return if (isLostAfterwards) ByteLink.LOST else 0
            return says[next++].toByteArray().also { it.copyInto(into) }.size
        }

        override fun write(bytes: ByteArray): Boolean {
            written.append(bytes.decodeToString())
            return true
        }

        override fun close() = Unit
    }

    private fun rmc(time: String, latitude: String) =
        "{\"s1\":{\"type\":\"gps\",\"data\":\"\$GPRMC,$time,A,$latitude,N,07336.0000,W,0.0,0.0,211126,,\"}}\r\n"

    private fun imu(heading: Double, magnetometer: Int) =
        "{\"s2\":{\"type\":\"imu\",\"data\":\"$heading,3,$magnetometer,3,3\"}}\r\n"

    private fun ByteLink.readAll() {
        val buffer = ByteArray(4096)
        while (read(buffer) > 0) Unit
    }

    @Test
    fun aLaptopHasItsFixesAndItsHeadingFromTheBoard() {
        val phone = BoardPhone(declinationDeg = -14.0)
        assertTrue("no fix" in phone.trouble() && "no calibrated heading" in phone.trouble())
        val link = phone.tap(
            Scripted("{\"m0\":{\"v\":0}}\r\n" + imu(10.0, 0), rmc("101530.00", "4530.0000"), imu(104.0, 2)),
        )
        val first = phone.await()
        assertEquals(0, first.fixes.size)
        link.readAll()
        val moment = phone.await()
        assertTrue(moment.time > first.time)
        val fix = moment.fixes.single()
        assertEquals(45.5, fix.place.latitudeDeg, 1e-9)
        assertEquals(-73.6, fix.place.longitudeDeg, 1e-9)
        // Nothing is known of the receiver's delay from one fix: it counts from when it was heard.
        assertEquals(first.time.seconds, fix.time.seconds, 1e-9)
        // 104 degrees by a compass that points 14 degrees west of north: due east.
        assertEquals(0.0, moment.heading, 1e-9)
        assertEquals("", phone.trouble())
        assertTrue(phone.await().run { fixes.isEmpty() && heading.isNaN() }, "nothing is said twice")
    }

    @Test
    fun aFixThatWasLongUnderWayIsDatedBack() {
        val phone = BoardPhone(0.0)
        val link = phone.tap(
            Scripted(rmc("235959.00", "4530.0000"), rmc("235959.05", "4530.0001"), rmc("000001.00", "4530.0002")),
        )
        val buffer = ByteArray(4096)
        val fixes = (1..3).flatMap {
            phone.await()
            link.read(buffer)
            phone.await().fixes
        }
        assertEquals(3, fixes.size)
        // The second came 0.2 s after the first and is of 0.05 s after it.
        assertEquals(0.05, fixes[1].time - fixes[0].time, 1e-3)
        // At midnight the receiver's clock begins anew; the fix is not lost.
        assertTrue(fixes[2].time > fixes[1].time)
    }

    private fun report(tick: Long, time: Double) = PhoneReport(tick, time, 0.5, 0.0, PhoneReport.Fix(time, 45.5, -73.6))

    @Test
    fun timeComesFromThePhonesChannelAndGoesOnWithoutIt() {
        val second = Scripted(report(1, 0.1).line())
        val first = Scripted(report(7, 3.0).line() + "rubbish\n", isLostAfterwards = true)
        val channel = PhoneChannel(ReconnectingWire({ second }, first))
        val told = channel.await()
        assertEquals(3.0, told.time.seconds)
        assertEquals(3.0, told.fixes.single().time.seconds)
        channel.done()
        assertEquals("{\"done\":7}\n", first.written.toString())
        // The boat is started anew, its clock at 0: the mission's time does not go back.
        var moment = channel.await()
        var last = told.time
        while (moment.fixes.isEmpty()) {
            assertTrue(moment.time > last && moment.heading.isNaN(), "time goes on by itself")
            last = moment.time
            moment = channel.await()
        }
        assertTrue(moment.time > last)
        assertEquals(moment.time, moment.fixes.single().time)
        assertTrue("1 of the phone's lines unreadable" in channel.trouble())
        channel.done()
        assertEquals("{\"done\":1}\n", second.written.toString())
    }

    @Test
    fun aSlowMachineIsWaitedForAndTheClockNotShifted() {
        var wall = 0L
        val first = Scripted(
            report(1, 3.0).line(),
            *Array(150) { "" },
            report(2, 3.1).line(),
            *Array(250) { "" },
            report(3, 3.3).line(),
        )
        // Each reading takes 10 ms: 1.5 s pass in the first silence, and 2.5 s in the second.
        val wire = ReconnectingWire({ throw WireProblem("gone") }, first)
        val channel = PhoneChannel(wire) { wall.also { wall += 10_000_000 } }
        assertEquals(3.0, channel.await().time.seconds)
        assertEquals(3.1, channel.await().time.seconds)
        assertEquals(0, channel.timesAlone)
        assertEquals("", channel.trouble())
        val moments = generateSequence { channel.await() }.takeWhile { it.fixes.isEmpty() }.toList()
        assertEquals(1, channel.timesAlone)
        assertContains(channel.trouble(), "1 time without the phone")
        assertTrue(moments.size in 4..6, "${moments.size} steps alone, of 0.1 s each, in the 0.5 s after the patience")
        assertTrue(moments.zipWithNext().all { (a, b) -> b.time > a.time })
    }

    @Test
    fun whatIsNoReportIsNone() {
        val report = report(3, 0.30000000000000004)
        assertEquals(report, PhoneReport.parse(report.line()))
        val missing = "{\"tick\":1,\"t_s\":1}"
        for (line in listOf("", "{", "[]", missing, report.line().replace("45.5", "95.5"), report.line().take(20))) {
            assertNull(PhoneReport.parse(line), line)
        }
        assertEquals(12, PhoneReport.answered("{\"done\":12}\n"))
        for (line in listOf(
            "",
            "12",
            "{\"done\":}",
            "{\"done\":x}",
            "done",
        )) {
            assertNull(PhoneReport.answered(line), line)
        }
    }

    @Test
    fun aWireThatCannotBeOpenedAgainStaysLost() {
        val wire = ReconnectingWire({ throw WireProblem("gone") }, Scripted(isLostAfterwards = true))
        assertEquals(ByteLink.LOST, wire.read(ByteArray(10)))
        assertEquals(ByteLink.LOST, wire.read(ByteArray(10)))
        assertEquals(1, wire.losses)
        assertEquals(0, wire.reconnections)
        assertTrue(!wire.write(byteArrayOf(1)))
        wire.close()
    }

    @Test
    fun aChannelThatNeverStopsSendingIsTakenForSilent() {
        for (line in listOf("rubbish\n", "rubbish ", "{\"tick\":0}\n")) {
            val endless = object : BoardWire {
                override fun read(into: ByteArray): Int = line.toByteArray().also { it.copyInto(into) }.size

                override fun write(bytes: ByteArray): Boolean = true

                override fun close() = Unit
            }
            var wall = 0L
            val wire = ReconnectingWire({ throw WireProblem("not there") }, endless)
            PhoneChannel(wire) { wall.also { wall += 1_000_000 } }.use { phone ->
                val first = phone.await()
                assertEquals(0.1, first.time.seconds, 1e-9)
                assertEquals(1, phone.timesAlone)
                assertTrue(phone.await().time > first.time, line)
            }
        }
    }
}
