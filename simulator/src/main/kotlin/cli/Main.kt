package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.CliktError
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.core.context
import com.github.ajalt.clikt.core.parse
import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.parameters.options.versionOption
import stillwater.report.Program
import java.nio.file.InvalidPathException
import kotlin.system.exitProcess

/** The `stillwater` command; its work is in its subcommands. */
class Stillwater : CliktCommand("stillwater") {
    init {
        context { helpFormatter = { OneLineErrors(it) } }
        versionOption(Program.VERSION)
    }

    override fun run() = Unit
}

fun main(args: Array<String>) {
    val command = Stillwater().subcommands(
        BenchmarkCommand(),
        MapCommand(),
        CorrectCommand(),
        DiagnoseCommand(),
        SimulateCommand(),
        VirtualBoatCommand(),
        DriveCommand(),
        ReplayCommand(),
    )
    try {
        command.parse(args)
    } catch (wrong: UsageError) {
        command.echoFormattedHelp(wrong)
        exitProcess(BAD_INPUT)
    } catch (error: CliktError) {
        command.echoFormattedHelp(error)
        exitProcess(error.statusCode)
    } catch (path: InvalidPathException) {
        fail("'${path.input}' cannot be a path in this locale (${path.reason}); set LC_ALL=C.UTF-8")
    } catch (_: OutOfMemoryError) {
        val megabytes = Runtime.getRuntime().maxMemory() / (1L shl 20)
        fail("$megabytes MB of memory are not enough; give Java more (java -Xmx2g -jar ...) or ask for fewer cells")
    }
    if (System.out.checkError()) fail("standard output could not be written")
}

private fun fail(message: String): Nothing {
    System.err.println("stillwater: $message")
    exitProcess(BAD_INPUT)
}
