package stillwater.io

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.model.LocalFrame
import stillwater.model.Reading
import stillwater.model.Utm
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.math.abs
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** The three versions with all their traps, written here line by line after the samples. */
class PlatypusLogTest {
    @TempDir
    private lateinit var directory: Path

    private class Found(val log: SurveyLog, val pass: LogPass, val readings: List<Reading>)

    private fun read(text: String, choice: LogChoice = LogChoice(), name: String = "platypus.txt"): Found {
        val log = SurveyLog.open(directory.resolve(name).apply { writeText(text) }, choice)
        val pass = log.read { _, _, _, _, _ -> }
        return Found(log, pass, log.readings())
    }

    @Test
    fun readsVersion400() {
        val text = """
            |2480703 18:36:22,325 POSE: {476608.34, 4671214.4, 172.35, Q[0.0,0.0,0.0]} @ 17North${" "}
            |2480713 18:36:22,335 VEL: Twist[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]${" "}
            |2481000 18:36:22,622 POSE: {591751.0, 4482749.0, 181.0, Q[0.0,0.0,-0.42]} @ 17North${" "}
            |2481001 18:36:22,623 Battery Voltage: 4 Sensor4(BATTERY)[12.463, 9045.454102, 0.0]${" "}
            |2481100 18:36:22,722 ES2: [e, 249.000000, 19.500000]${" "}
            |2481109 18:36:22,731 POSE: {591751.5, 4482749.0, 181.0, Q[0.0,0.0,-0.42]} @ 17North${" "}
            |2481099 18:36:22,738 COMPASS: -0.40${" "}
            |2481150 18:36:22,772 SENSOR1: {"data":"7.78","type":"atlas_do"}${" "}
            |2481200 18:36:22,822 POSE: {591752.0, 4482749.0, 181.0, Q[0.0,0.0,-0.42]} @ 17North${" "}
            |2481300 18:36:22,922 ES2: [e, 251.000000, 19.600000]${" "}
        """.trimMargin()
        val temperature = read(text, LogChoice(value = "ES2.temp"))
        assertEquals("Platypus log 4.0.0", temperature.log.format)
        assertEquals(listOf(19.5, 19.6), temperature.readings.map { it.value })
        assertEquals(mapOf("poses before the first fix" to 1L), temperature.pass.skipped)
        assertEquals(2481.1, temperature.readings[0].time.seconds)
        assertEquals(listOf(249.0, 251.0), read(text, LogChoice(value = "es2.EC")).readings.map { it.value })
        assertEquals(listOf(7.78), read(text, LogChoice(value = "ATLAS_DO")).readings.map { it.value })
        val unknown = assertFailsWith<LogProblem> { read(text, LogChoice(value = "ATLAS_PH")) }.message.orEmpty()
        assertTrue("found ATLAS_DO (1 line), ES2.ec|temp (2 lines)" in unknown, unknown)
    }

    @Test
    fun readsVersion410WithItsTraps() {
        val text = """
            |776240 18:47:34,395 {"gain":{"axis":0,"values":"[D@8e7c7e5"}}
            |2990266 19:24:28,421 {"pose":{"p":[337185.0,4467663.0,59],"q":[0.33,0,-0.94,0],"zone":"18North"}}
            |2990300 19:24:29,71 {"sensor":{"channel":1,"type":"ATLAS_DO","data":[10.15]}}
            |2990366 19:24:29,137 {"pose":{"p":[337186.0,4467663.0,59],"q":[0.33,0,-0.94,0],"zone":"18North"}}
            |5955440 20:13:53,595 {"pose":{"p":[337679.0,4467651.0,64],"q":[0.66,0,-0.75,0],"zone":"18North"}}
            |5955500 20:13:53,655 {"sensor":{"channel":1,"type":"ATLAS_DO","data":[10.56]}}
        """.trimMargin()
        val found = read(text)
        assertEquals("Platypus log 4.1.0", found.log.format)
        assertEquals("ATLAS_DO", found.log.quantity)
        assertEquals(listOf(10.15, 10.56), found.readings.map { it.value })
        assertEquals(2965.2, found.readings[1].time - found.readings[0].time, 1e-9, "minutes between joined logs")
        assertTrue(abs(found.readings[1].position.x - 494) < 1, "no interpolation over the gap")
    }

    @Test
    fun readsVersion420InUnixTimeAndJoined() {
        val text = listOf(
            "0\tI\t{\"date\":\"Thu May 19 13:36:23 EDT 2016\",\"time\":1463679383361}",
            pose(100, 592_300.0),
            sensor(150, 7.49),
            pose(200, 592_300.5),
            "0\tI\t{\"date\":\"Thu May 19 13:46:23 EDT 2016\",\"time\":1463679983361}",
            pose(100, 592_310.0),
            "130\tW\t{\"winch\":{\"depth\":1}}",
            sensor(150, 7.50),
            pose(200, 592_310.5),
        ).joinToString("\n")
        val found = read(text)
        assertEquals("Platypus log 4.2.0", found.log.format)
        assertEquals(1463679383.511, found.readings[0].time.seconds, 1e-6)
        assertEquals(600.0, found.readings[1].time - found.readings[0].time, 1e-6)
    }

    /** A boat whose clock ran sixty times as fast as the wall's: the log of a mission that was taken up again. */
    @Test
    fun wherePartsOfAMissionOverlapByTheWallsClockTheBoatsCounts() {
        fun step(millis: Int, seconds: Double) =
            pose(millis, 592_300.0).removeSuffix("}") + ",\"mission\":{\"t_s\":$seconds,\"state\":\"surveying\"}}"

        fun log(again: Double) = listOf(
            "0\tI\t{\"date\":\"once\",\"time\":1463679383361}",
            step(100, 500.1),
            sensor(60_000, 7.0),
            step(60_100, 560.1),
            "0\tI\t{\"date\":\"a second later\",\"time\":1463679384361}",
            step(1, again),
            sensor(500, 8.0),
            step(1001, again + 1.0),
        ).joinToString("\n")
        val found = read(log(again = 600.1))
        assertEquals(listOf(7.0, 8.0), found.readings.map { it.value })
        assertEquals(40.1 + 0.499, found.readings[1].time - found.readings[0].time, 1e-6)
        // A boat's clock that began anew as well tells nothing.
        val problem = assertFailsWith<LogProblem> { read(log(again = 3.0)) }
        assertEquals(6L, problem.line, problem.message)
    }

    @Test
    fun placesAReadingBetweenThePosesAroundIt() {
        val text = listOf(pose(0, 592_300.0), sensor(250, 1.0), pose(1000, 592_304.0), sensor(1500, 2.0))
        val found = read(text.joinToString("\n"))
        val frame = checkNotNull(found.log.frame)
        fun at(easting: Double) = LocalFrame(frame.origin).toLocal(Utm(easting, 4_481_762.0, 17, true).toLatLon())
        assertEquals(0.0, found.readings[0].position.distanceTo(at(592_301.0)), 1e-6)
        assertEquals(0.0, found.readings[1].position.distanceTo(at(592_304.0)), 1e-6, "the last pose stands")
    }

    @Test
    fun countsReadingsThatNoPoseIsNear() {
        val lines =
            listOf(
                sensor(10, 1.0),
                pose(5000, 592_300.0),
                sensor(6000, 2.0),
                sensor(9000, 3.0),
                pose(20_000, 592_300.0),
            )
        assertEquals(mapOf("readings without a pose" to 2L), read(lines.joinToString("\n")).pass.skipped)
        val patient = read(lines.joinToString("\n"), LogChoice(maxPoseAge = 30.0))
        assertEquals(3L, patient.pass.readings)
        // The third reading lies between two poses now; the first waits for the pose that comes 5 s later.
        assertTrue(patient.pass.skipped.isEmpty())
    }

    @Test
    fun howATablesTimesAreReadIsNothingToIt() {
        val text = listOf(pose(0, 592_300.0), sensor(100, 1.0), pose(200, 592_300.0)).joinToString("\n")
        val choices = mapOf(
            "--time-unit" to LogChoice(timeUnit = TimeUnit.HOURS),
            "--date-order" to LogChoice(dateOrder = DateOrder.DAY_FIRST),
            "--overnight" to LogChoice(overnight = 3600.0),
        )
        for ((flag, choice) in choices) {
            val problem = assertFailsWith<LogProblem> { read(text, choice) }
            assertTrue(
                "expected a survey CSV for $flag, found a Platypus log" in problem.message.orEmpty(),
                problem.message,
            )
        }
    }

    @Test
    fun forgivesACutLastLineOfAnUnfinishedLogOnly() {
        val text = listOf(
            pose(0, 592_300.0),
            sensor(50, 1.0),
            sensor(90, 2.0),
            "120\tI\t{\"pose\":{\"p\":[5923",
        ).joinToString("\n")
        val found = read(text, name = "platypus.txt.incomplete")
        assertEquals(mapOf("truncated last line" to 1L), found.pass.skipped)
        assertFailsWith<LogProblem> { read(text, name = "platypus.txt") }
    }

    @Test
    fun keepsTheTimeGrowingWhereTheAppWasRestarted() {
        fun line(millis: Int, clock: String, json: String) = "$millis $clock $json"
        val fix = """{"pose":{"p":[337185.0,4467663.0,59],"q":[1,0,0,0],"zone":"18North"}}"""
        fun oxygen(value: Double) = """{"sensor":{"channel":1,"type":"ATLAS_DO","data":[$value]}}"""
        val text = listOf(
            line(90_000, "23:58:00,0", fix),
            line(90_100, "23:58:00,100", oxygen(1.0)),
            line(200, "0:01:00,100", fix),
            line(300, "0:01:00,200", oxygen(2.0)),
        ).joinToString("\n")
        val readings = read(text).readings
        assertEquals(180.1, readings[1].time - readings[0].time, 1e-9, "over midnight")
        val back = text.replace("0:01:00", "23:57:00")
        val problem = assertFailsWith<LogProblem> { read(back) }
        assertEquals(3L, problem.line)
    }

    @Test
    fun saysThatOnlyPlaceholdersAreThere() {
        val text = listOf(
            "0\tI\t{\"pose\":{\"p\":[476608.35,4671214.5,172.35],\"q\":[1,0,0,0],\"zone\":\"17North\"}}",
            sensor(50, 1.0),
        ).joinToString("\n")
        val problem = assertFailsWith<LogProblem> { read(text) }
        assertEquals("only the placeholder before the first fix (1 poses)", problem.found)
    }

    private fun pose(millis: Int, easting: Double) =
        "$millis\tI\t{\"pose\":{\"p\":[$easting,4481762.0,252],\"q\":[1,0,0,0],\"zone\":\"17North\"}}"

    private fun sensor(millis: Int, value: Double) =
        "$millis\tI\t{\"sensor\":{\"channel\":1,\"type\":\"ATLAS_DO\",\"data\":[$value]}}"
}
