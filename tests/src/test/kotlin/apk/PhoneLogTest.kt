package stillwater.apk

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.MapCommand
import stillwater.cli.Stillwater
import java.io.File
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A log that the app wrote in its own tests, as whoever brings the boat home reads it. */
class PhoneLogTest {
    @TempDir
    private lateinit var directory: File
    private val logs = Built.app.resolve("target/mission-logs")

    @Test
    fun mapReadsEveryReadingThatThePhoneWrote() {
        // One for each Android, all of the same mission.
        val log = Built.existing(logs.resolve("android-35.log"), "the app's WholeMissionTest")
        val out = directory.resolve("map")
        val run = Stillwater().subcommands(MapCommand())
            .test(listOf("map", log.path, "--out", out.path, "--filter", "averaging"))
        assertEquals(0, run.statusCode, run.output)
        val readings = log.readLines().count { "\"ATLAS_DO\"" in it }
        assertContains(run.stdout, Regex("readings +$readings of ATLAS_DO"))
        val rows = out.resolve("cells.csv").readLines()
        val columns = rows.first().split(',')
        val cells = rows.drop(1).map { row -> columns.zip(row.split(',')).toMap() }
        assertEquals(readings, cells.sumOf { it.getValue("readings").toInt() })
        val values = cells.mapNotNull { it.getValue("value").toDoubleOrNull() }
        // The water that the app's test sails on has 5 to 9 mg/L.
        assertTrue(values.size > 10 && values.all { it in 5.0..9.0 }, "$values")
    }
}
