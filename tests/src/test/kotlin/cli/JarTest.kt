package stillwater.cli

import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.BeforeEach
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.CsvSource
import java.io.File
import java.util.concurrent.TimeUnit
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** The program as people run it: the fat jar in a process of its own. */
class JarTest {
    @TempDir
    private lateinit var directory: File
    private val jar = generateSequence(File("").absoluteFile) { it.parentFile }
        .first { it.resolve("settings.gradle.kts").isFile }
        .resolve("simulator/target/stillwater.jar")

    @BeforeEach
    fun theJarIsBuilt() {
        assumeTrue(jar.isFile, "$jar is missing, `mvn package` makes it: the program is not tried as a process")
    }

    private class Outcome(val code: Int, val out: String, val err: String) {
        override fun toString() = "exit code $code\n--- out\n$out--- err\n$err"
    }

    private fun stillwater(vararg arguments: String): Outcome {
        val java = File(System.getProperty("java.home"), "bin/java").path
        val out = directory.resolve("stdout")
        val err = directory.resolve("stderr")
        val process = ProcessBuilder(listOf(java, "-jar", jar.path) + arguments)
            .directory(directory)
            .redirectOutput(out)
            .redirectError(err)
            .apply { environment().keys.removeAll(setOf("JAVA_TOOL_OPTIONS", "JDK_JAVA_OPTIONS", "_JAVA_OPTIONS")) }
            .start()
        // Far longer than any of these takes on a busy machine; a process that hangs must not hold up the build.
        val ended = process.waitFor(5, TimeUnit.MINUTES)
        if (!ended) process.destroyForcibly().waitFor()
        assertTrue(ended, "stillwater ${arguments.joinToString(" ")} did not end")
        return Outcome(process.exitValue(), out.readText(), err.readText())
    }

    private fun assertFine(outcome: Outcome) {
        assertEquals(0, outcome.code, "$outcome")
        assertEquals("", outcome.err, "nothing but problems belongs there, no library's notes either")
    }

    @Test
    fun helpNamesTheCommands() {
        val help = stillwater("--help")
        assertFine(help)
        assertContains(help.out, "benchmark")
        assertContains(help.out, "map")
    }

    /** What every command's help says, and how each answers, is MainTest's, in process. */
    @Test
    fun aCommandHasHelpWithExamples() {
        val help = stillwater("map", "--help")
        assertFine(help)
        assertContains(help.out, "stillwater map survey.csv")
    }

    @Test
    fun benchmarkWritesItsFilesAndPrintsItsTables() {
        val run = stillwater("benchmark", "--out", "bench", "--environments", "2", "--moves", "20")
        assertFine(run)
        assertContains(run.out, "Mean absolute error, field uniform, by moves")
        val written = directory.resolve("bench").list().orEmpty().sorted()
        val figures = listOf("figure-6.png", "figure-6.svg", "figure-7.png", "figure-7.svg")
        assertEquals(
            listOf("bounds.csv", "extremes.csv") + figures + listOf("report.html", "results.csv", "sensor.json"),
            written,
        )
        assertFalse(
            "development" in directory.resolve("bench/report.html").readText(),
            "the report names the version that the jar's manifest has",
        )
    }

    @Test
    fun mapWritesItsFilesFromALog() {
        val rows = (0 until 60).joinToString("") { i ->
            "$i,${45.5 + i % 12 * 1e-5},${-73.1 + i / 12 * 1e-5},${8 + i * 0.01}\n"
        }
        directory.resolve("survey.csv").writeText("time_s,lat_deg,lon_deg,do_mg_l\n$rows")
        val run = stillwater("map", "survey.csv", "--out", "lake", "--cell", "2", "--filter", "averaging")
        assertFine(run)
        assertContains(run.out, "Map of do_mg_l")
        val written = directory.resolve("lake").list().orEmpty().toSet()
        val due = setOf("cells.csv", "cells.geojson", "track.svg", "track.png", "report.html")
        assertTrue(written.containsAll(due), "$due are not all in $written")
    }

    @ParameterizedTest
    @CsvSource(
        "no such option, benchmark --bogus 3",
        "found no such file, map nowhere.csv",
    )
    fun aWrongCommandLineIsOneLineAndExitCodeTwo(message: String, typed: String) {
        val run = stillwater(*typed.split(' ').toTypedArray())
        assertEquals(2, run.code, "$run")
        assertEquals("", run.out)
        assertEquals(1, run.err.trimEnd().lines().size, "$run")
        assertContains(run.err, message)
        assertEquals(listOf("stderr", "stdout"), directory.list().orEmpty().sorted())
    }
}
