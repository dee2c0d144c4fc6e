package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.CliktError
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.core.context
import com.github.ajalt.clikt.core.parse
import com.github.ajalt.clikt.core.subcommands
import kotlin.system.exitProcess

/** The `stillwater` command; its work is in its subcommands. */
class Stillwater : CliktCommand("stillwater") {
    init {
        context { helpFormatter = { OneLineErrors(it) } }
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
