package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.main

/** The `stillwater` command; its work is in its subcommands. */
class Stillwater : CliktCommand("stillwater") {
    override fun run() = Unit
}

fun main(args: Array<String>) = Stillwater().main(args)
