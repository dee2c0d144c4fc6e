package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.CliktError
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.core.context
import com.github.ajalt.clikt.core.parse
import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.parameters.options.versionOption
import stillwater.report.Program
import java.io.PrintStream
import java.nio.file.InvalidPathException
import kotlin.system.exitProcess

/** The `stillwater` command; its work is in its subcommands. */
class Stillwater : CliktCommand("stillwater") {
    init {
        context {
            helpFormatter = { OneLineErrors(it) }
            suggestTypoCorrection = OneLineErrors::suggestion
        }
        versionOption(Program.VERSION)
    }

    override fun run() = Unit
}

fun main(args: Array<String>) {
    val output = StandardOutput.install()
    val status = run(Stillwater().subcommands(commands()), args, System.getenv(TRACE) != null, System.err)
    System.out.flush()
    if (output.isLost) {
        System.err.println("stillwater: standard output could not be written")
        exitProcess(BAD_INPUT)
    }
    if (status != 0) exitProcess(status)
}

/** All there are, new ones, in the order of the help. */
internal fun commands(): List<CliktCommand> = listOf(
    BenchmarkCommand(),
    MapCommand(),
    CorrectCommand(),
    DiagnoseCommand(),
    SimulateCommand(),
    VirtualBoatCommand(),
    DriveCommand(),
    ReplayCommand(),
)

/**
 * Runs [command] with [args]; answers the exit code. What no command expects ends in one line on [errors] too, with the
 * place in the program where [isTraced].
 */
internal fun run(command: CliktCommand, args: Array<String>, isTraced: Boolean, errors: PrintStream): Int {
    fun failed(message: String, why: Throwable, status: Int): Int {
        errors.println("stillwater: $message")
        if (isTraced) why.printStackTrace(errors)
        return status
    }
    return try {
        command.parse(args)
        0
    } catch (wrong: UsageError) {
        command.echoFormattedHelp(wrong)
        BAD_INPUT
    } catch (error: CliktError) {
        command.echoFormattedHelp(error)
        error.statusCode
    } catch (path: InvalidPathException) {
        val message = "'${path.input}' cannot be a path in this locale (${path.reason}); set LC_ALL=C.UTF-8"
        failed(message, path, BAD_INPUT)
    } catch (full: OutOfMemoryError) {
        failed(tooLittleMemory(Runtime.getRuntime().maxMemory()), full, BAD_INPUT)
    } catch (
        @Suppress("TooGenericExceptionCaught") bug: Throwable,
    ) {
        val what = (bug.message ?: bug.javaClass.simpleName).lineSequence().first()
        val remedy = if (isTraced) "" else "; with $TRACE=1 in the environment it says where"
        failed("a mistake in the program (${bug.javaClass.simpleName}: $what)$remedy", bug, BUG)
    }
}

/** That a heap of at most [bytes] is not enough, and what to do: twice as much, in whole GB. */
internal fun tooLittleMemory(bytes: Long): String {
    val megabytes = bytes / MEGABYTE
    val gigabytes = (2 * megabytes + MEGABYTES_IN_A_GIGABYTE - 1) / MEGABYTES_IN_A_GIGABYTE
    return "$megabytes MB of memory are not enough; give Java more (java -Xmx${gigabytes}g -jar ...) if the machine " +
        "has it, ask for fewer cells, or give a shorter log"
}

private const val MEGABYTE = 1L shl 20
private const val MEGABYTES_IN_A_GIGABYTE = 1024

/** In the environment: a mistake in the program is told with the place where it happened. */
private const val TRACE = "STILLWATER_TRACE"

/** Exit code of a mistake in the program, as sysexits.h has it. */
private const val BUG = 70
