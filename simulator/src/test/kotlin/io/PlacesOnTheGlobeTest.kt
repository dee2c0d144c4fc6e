package stillwater.io

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.DiagnoseCommand
import stillwater.cli.Stillwater
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Utm
import java.nio.file.Path
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What the commands write of a log whose places are not in the file as degrees can be put on a map. */
class PlacesOnTheGlobeTest {
    @TempDir
    private lateinit var directory: Path

    private val out: Path get() = directory.resolve("results")

    private fun run(command: String, file: Path, vararg more: String) {
        val result = Stillwater().subcommands(CorrectCommand(), DiagnoseCommand())
            .test(listOf(command, file.toString(), "--out", out.toString()) + more)
        assertEquals(0, result.statusCode, result.output)
    }

    private fun east(seconds: Double) = 592_300 + 0.7 * seconds

    private fun north(seconds: Double) = 4_481_762 + 3 * sin(seconds / 40)

    private fun pose(i: Int): String {
        val at = "[${east(i / 2.0)},${north(i / 2.0)},252]"
        return "${500 * i}\tI\t{\"pose\":{\"p\":$at,\"q\":[1,0,0,0],\"zone\":\"17North\"}}\n"
    }

    /** A pose each half second and a reading between each two. */
    private fun platypus(): Path = directory.resolve("platypus.txt").apply {
        writeText(
            "0\tI\t{\"date\":\"Thu May 19\",\"time\":1463679383361}\n" + (1..90).joinToString("") { i ->
                pose(i) + "${500 * i + 250}\tI\t{\"sensor\":{\"channel\":1,\"type\":\"ATLAS_DO\",\"data\":[7.$i]}}\n"
            } + pose(91),
        )
    }

    private fun origin(file: String): LocalFrame {
        val origin = Json.parseToJsonElement(out.resolve(file).readText()).jsonObject.getValue("origin").jsonObject
        fun number(name: String) = origin.getValue(name).jsonPrimitive.double
        return LocalFrame(LatLon(number("lat_deg"), number("lon_deg")))
    }

    /** The rows of [table] stand within a centimetre of where the boat was, by degrees and by the frame's metres. */
    private fun check(table: String, summary: String) {
        val rows = out.resolve(table).readLines().map { it.split(',') }
        assertEquals(listOf("time_s", "lat_deg", "lon_deg", "x_m", "y_m"), rows[0].take(5))
        val frame = origin(summary)
        for (row in rows.drop(1)) {
            val numbers = row.take(5).map { it.toDouble() }
            val seconds = numbers[0] - 1_463_679_383.361
            val there = frame.toLocal(Utm(east(seconds), north(seconds), 17, true).toLatLon())
            val told = frame.toLocal(LatLon(numbers[1], numbers[2]))
            // Between poses the boat went straight, which this curve leaves by less than 0.1 mm.
            assertTrue(hypot(told.x - there.x, told.y - there.y) < 0.01, "$row: $told, not $there")
            assertTrue(hypot(numbers[3] - there.x, numbers[4] - there.y) < 0.01, "$row: not $there")
        }
    }

    @Test
    fun correctedRowsOfAPlatypusLogHaveLatitudeAndLongitude() {
        run("correct", platypus(), "--value", "ATLAS_DO")
        check("corrected.csv", "summary.json")
    }

    @Test
    fun correctedPlatypusLogIsALogAgain() {
        run("correct", platypus(), "--value", "ATLAS_DO")
        val again = SurveyLog.open(out.resolve("corrected.csv"), LogChoice(value = "corrected"))
        assertEquals(90, again.readings().size)
    }

    @Test
    fun residualsOfALogInDegreesHaveLatitudeAndLongitude() {
        run("diagnose", platypus(), "--value", "ATLAS_DO", "--numbers-only")
        check("residuals.csv", "diagnosis.json")
    }

    @Test
    fun logInMetresHasNoOrigin() {
        val file = directory.resolve("metres.csv")
        file.writeText("time_s,x_m,y_m,v\n" + (0 until 40).joinToString("") { "$it,$it,0,${it % 7}\n" })
        run("diagnose", file, "--numbers-only")
        assertEquals("time_s,x_m,y_m,measured", out.resolve("residuals.csv").readLines()[0].take(23))
        assertTrue("origin" !in Json.parseToJsonElement(out.resolve("diagnosis.json").readText()).jsonObject)
    }
}
