package stillwater.cli

import com.github.ajalt.clikt.core.ParameterHolder
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.multiple
import com.github.ajalt.clikt.parameters.options.option
import com.github.ajalt.clikt.parameters.options.validate
import stillwater.estimate.UndoableSensor
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec

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

/**
 * Refuses [conditions] that lack one on which [sensor], read from [file], depends, and those on which it does not. The
 * speed, where it is not among them, is taken from the positions.
 */
internal fun requireNeeded(conditions: List<Pair<String, String>>, file: String, sensor: SensorSpec) {
    val needs = UndoableSensor.of(sensor).needs
    val names = conditions.map { it.first }
    val missing = needs - names.toSet() - Conditions.SPEED
    if (missing.isNotEmpty()) {
        val options = missing.joinToString(" and ") { "--condition $it=COLUMN" }
        throw BadFlag("--sensor: $file", "$options, which undoing it takes", "none")
    }
    val unused = names - needs
    if (unused.isEmpty()) return
    val expected = if (needs.isEmpty()) {
        "none, for the sensor given depends on none"
    } else {
        "${needs.joinToString(" and ")}, on which the sensor given depends"
    }
    throw BadFlag("--condition", expected, unused.joinToString(" and "))
}
