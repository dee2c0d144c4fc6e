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
    } catch (error: CliktError) {
        command.echoFormattedHelp(error)
        exitProcess(if (error is UsageError) BAD_INPUT else error.statusCode)
    }
}
