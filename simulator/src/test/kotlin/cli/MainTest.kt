package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import java.io.ByteArrayOutputStream
import java.io.IOException
import java.io.OutputStream
import java.io.PrintStream
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class MainTest {
    private class Failing(private val why: Throwable) : CliktCommand("failing") {
        override fun run() = throw why
    }

    private fun outcome(why: Throwable, isTraced: Boolean): Pair<Int, List<String>> {
        val errors = ByteArrayOutputStream()
        val status = run(Failing(why), emptyArray(), isTraced, PrintStream(errors, true))
        return status to errors.toString().trimEnd().lines()
    }

    @Test
    fun aMistakeInTheProgramIsOneLineAndACodeOfItsOwn() {
        val bug = IllegalStateException("the cell -1 is none\nof the grid")
        val words = "stillwater: a mistake in the program (IllegalStateException: the cell -1 is none)"
        assertEquals(
            70 to listOf("$words; with STILLWATER_TRACE=1 in the environment it says where"),
            outcome(bug, false),
        )
        val (status, lines) = outcome(bug, true)
        assertEquals(70, status)
        assertEquals(words, lines[0])
        assertTrue(lines.any { "MainTest" in it }, "the place is told: $lines")
        assertEquals(70, outcome(StackOverflowError(), false).first)
    }

    @Test
    fun tooLittleMemoryIsTheMachinesAndSaysWhatToDo() {
        val (status, lines) = outcome(OutOfMemoryError(), false)
        assertEquals(2, status)
        assertEquals("stillwater: ${tooLittleMemory(Runtime.getRuntime().maxMemory())}", lines.single())
        for ((megabytes, flag) in listOf(256L to "-Xmx1g", 1024L to "-Xmx2g", 1025L to "-Xmx3g", 5827L to "-Xmx12g")) {
            val words = tooLittleMemory(megabytes shl 20)
            val begin = "$megabytes MB of memory are not enough; give Java more (java $flag -jar ...)"
            assertEquals("$begin if the machine has it, ask for fewer cells, or give a shorter log", words)
        }
    }

    @Test
    fun anExampleIsALineThatCanBeCopied() {
        for (command in commands()) {
            val help = Stillwater().subcommands(command).test(listOf(command.commandName, "--help"), width = 80).stdout
            val examples = help.substringAfter("Examples:\n").trim().lines()
            assertTrue(examples.all { "$it ".startsWith("stillwater ${command.commandName} ") }, "$examples")
        }
    }

    @Test
    fun aWrongCommandLineIsOneLine() {
        for ((typed, message) in listOf(
            "sail" to "no such subcommand",
            "--bogus" to "no such option",
            "benchmark --bogus 3" to "no such option",
            "benchmark noisy" to "got unexpected extra argument (noisy)",
            "benchmark --out" to "requires a value",
            "benchmark --moves many" to "--moves: expected a whole number",
            "map" to "missing argument",
            "map nowhere.csv" to "found no such file",
            "map log.csv --time-unit minutes" to "--time-unit: expected ms, s, min, h or d, found 'minutes'",
            "map log.csv --overnight 24" to "--overnight: expected a number of hours above 0 and below 24, found '24'",
        )) {
            val result = Stillwater().subcommands(commands()).test(typed)
            assertTrue(result.statusCode != 0, "$typed: ${result.output}")
            assertEquals("", result.stdout, typed)
            assertEquals(1, result.stderr.trimEnd().lines().size, "$typed: ${result.stderr}")
            assertTrue(message in result.stderr, "$typed: ${result.stderr}")
        }
    }

    @Test
    fun anOptionThatThereIsNoneOfNamesItsCommandAndWhatIsNear() {
        for ((typed, message) in listOf(
            "--bogus" to "stillwater: no such option --bogus (see stillwater --help)",
            "simulate pond.json --bogus 1" to
                "stillwater simulate: no such option --bogus (see stillwater simulate --help)",
            "map log.csv --val do" to
                "stillwater map: no such option --val. Did you mean --value? (see stillwater map --help)",
            "correct log.csv --refernce do" to
                "stillwater correct: no such option --refernce. Did you mean --reference? (see stillwater correct --help)",
        )) {
            assertEquals(message, Stillwater().subcommands(commands()).test(typed, width = 200).stderr.trimEnd())
        }
    }

    @Test
    fun allThatIsMissingIsSaidInOneLine() {
        val result = runBoatCommand("drive")
        val words = result.stderr.substringBefore(" (")
        assertEquals("stillwater drive: missing argument <mission>; missing option --port", words)
        assertEquals(1, result.stderr.trimEnd().lines().size)
    }

    private fun refusing(message: String) = StandardOutput(
        object : OutputStream() {
            override fun write(byte: Int) = throw IOException(message)
        },
    )

    @Test
    fun aReaderThatHasLeftIsNoProblemAndAFullDiskIsOne() {
        val left = refusing("Broken pipe")
        repeat(3) { left.printer.println("more") }
        assertFalse(left.isLost)
        assertFalse(left.printer.checkError())
        val full = refusing("No space left on device")
        full.printer.println("more")
        full.printer.flush()
        assertTrue(full.isLost)
    }
}
