package stillwater.cli

import com.github.ajalt.clikt.core.ParameterHolder
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.multiple
import com.github.ajalt.clikt.parameters.options.option
import com.github.ajalt.clikt.parameters.options.validate

/** The option `--condition NAME=COLUMN`, repeatable: names of further quantities and their columns, each name once. */
internal fun ParameterHolder.conditions(help: String) = option("--condition", metavar = "NAME=COLUMN", help = help)
    .convert { text ->
        val name = text.substringBefore('=').trim()
        val column = text.substringAfter('=', "").trim()
        if (name.isEmpty() || column.isEmpty()) throw BadFlag(this.name, "NAME=COLUMN", "'$text'")
        name to column
    }.multiple().validate { pairs ->
        val twice = pairs.groupingBy { it.first }.eachCount().entries.firstOrNull { it.value > 1 }
        if (twice != null) throw BadFlag("--condition", "each name once", "'${twice.key}' several times")
    }
