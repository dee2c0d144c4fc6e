package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.writeText
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Fixes that leap are told alike by every command that reads a log. */
class JumpWarningTest {
    @TempDir
    private lateinit var directory: Path

    private fun run(command: String, log: String, vararg more: String): CliktCommandTestResult {
        val file = directory.resolve("log").also { it.writeText(log) }
        return Stillwater().subcommands(MapCommand(), CorrectCommand(), DiagnoseCommand())
            .test(listOf(command, "$file", "--out", "${directory.out().resolve(command)}") + more)
    }

    /** Legs of 40 m to and fro, a second a metre, with [place] in the place of that of some rows. */
    private fun legs(place: (Int) -> String? = { null }) = buildString {
        appendLine("time_s,x_m,y_m,v")
        for (i in 0 until 240) {
            val along = (i % 80).let { if (it < 40) it else 80 - it }
            val value = String.format(Locale.ROOT, "%.2f", 8 + sin(along / 6.0))
            appendLine("$i,${place(i) ?: "${100 + along},${50 + i / 40 * 2}"},$value")
        }
    }

    /** Three rows 300 m off, and later one at 0, 0: each there and back. */
    private val leaps = legs { i -> "400,50".takeIf { i in 100..102 } ?: "0,0".takeIf { i == 150 } }

    private fun assertLeapsTold(command: String, vararg more: String) {
        val told = run(command, leaps, *more)
        assertEquals(0, told.statusCode, told.output)
        // Row 100 is line 102.
        val words = "4 jumps in the positions are faster than 20 m/s, the first at line 102: check the receiver's"
        assertContains(told.stderr, "$words fixes")
        val calm = run(command, legs(), *more)
        assertFalse("in the positions" in calm.stderr, calm.stderr)
    }

    @Test
    fun aFixThatLeapsIsTold() {
        assertLeapsTold("map")
        assertLeapsTold("correct")
        assertTrue(Regex(""""position_jumps": ?4\b""") in run("map", leaps, "--json").stdout)
    }

    /** A reading each second of such a log, as a Platypus boat writes it. */
    private val platypus = buildString {
        for (i in 1..240) {
            val along = (i % 80).let { if (it < 40) it else 80 - it } + if (i in 120..122) 300 else 0
            val pose = "[${500_000 + along}.0,${5_000_000 + i / 40 * 2}.0,0.0]"
            appendLine("${1000 * i}\tI\t{\"pose\":{\"p\":$pose,\"q\":[1,0,0,0],\"zone\":\"18North\"}}")
            val value = String.format(Locale.ROOT, "%.2f", 8 + sin(along / 6.0))
            appendLine("${1000 * i}\tI\t{\"sensor\":{\"channel\":1,\"type\":\"ATLAS_DO\",\"data\":[$value]}}")
        }
    }

    private fun assertPlatypusLeapsTold(command: String, vararg more: String) {
        val told = run(command, platypus, *more)
        assertEquals(0, told.statusCode, told.output)
        assertContains(told.stderr, "2 jumps in the positions are faster than 20 m/s, the first at line 240")
    }

    @Test
    fun theLineOfAPlatypusLogIsThatOfTheReading() {
        assertPlatypusLeapsTold("map")
        assertPlatypusLeapsTold("correct")
    }

    @Test
    @Tag("long")
    fun diagnoseTellsThemAlike() {
        assertLeapsTold("diagnose", "--numbers-only")
        assertPlatypusLeapsTold("diagnose", "--numbers-only")
    }
}
