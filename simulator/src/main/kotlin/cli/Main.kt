package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.CliktError
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.core.context
import com.github.ajalt.clikt.core.parse
import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.parameters.options.versionOption
import stillwater.report.Program
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
    val command = Stillwater().subcommands(BenchmarkCommand(), MapCommand())
    try {
        command.parse(args)
    } catch (wrong: UsageError) {
        command.echoFormattedHelp(wrong)
        exitProcess(BAD_INPUT)
    } catch (error: CliktError) {
        command.echoFormattedHelp(error)
        exitProcess(error.statusCode)
    }
}
