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
 * Refuses those of [conditions] on which [sensor] does not depend. Where it depends on some that are not there, or cannot
 * be undone at all, that is for others to say.
 */
internal fun requireNeeded(conditions: List<Pair<String, String>>, sensor: SensorSpec) {
    val needs = try {
        UndoableSensor.of(sensor).needs
    } catch (_: IllegalArgumentException) {
        return
    }
    val names = conditions.map { it.first }
    val unused = names - needs
    if (unused.isEmpty() || (needs - names.toSet() - Conditions.SPEED).isNotEmpty()) return
    val expected = if (needs.isEmpty()) {
        "none, for the sensor given depends on none"
    } else {
        "${needs.joinToString(" and ")}, on which the sensor given depends"
    }
    throw BadFlag("--condition", expected, unused.joinToString(" and "))
}
