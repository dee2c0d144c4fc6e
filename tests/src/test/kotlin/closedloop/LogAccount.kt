package stillwater.closedloop

import stillwater.estimate.FieldEstimator
import stillwater.estimate.update
import stillwater.field.FieldMap
import stillwater.mission.MissionRecovery
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Position
import stillwater.model.Reading

/** What a mission's log says of its readings, read by other means than the mission's own. */
internal class LogAccount(text: String, steps: List<Int> = emptyList()) {
    /** What changed the map, in order: a reading taken, or with a NaN a cell left without one. */
    val events: List<Reading>

    /** The step in which each of [events] was first written of, be it that it had to wait; empty where no steps were given. */
    val eventSteps: List<Int>

    /** Values of all the probe's lines in the log, whatever became of them. */
    val said: List<Double>

    private val header: String

    init {
        val all = text.split('\n')
        val lines = all.filter { it.endsWith("}") }
        header = lines.first { "\"spec\":" in it }
        val found = all.map { if (it.endsWith("}")) events(it) else emptyList() }
        events = found.flatten()
        eventSteps = if (steps.isEmpty()) emptyList() else firstSteps(all, steps, found)
        said = lines.filter { "\"reading\":" in it }.map {
            it.substringAfter("\"data\":[").substringBefore(']').toDoubleOrNull() ?: Double.NaN
        }
    }

    val readings: Int get() = events.count { !it.value.isNaN() }

    /** A fresh estimator with those of [events], by their number, that [kept] lets through. */
    fun estimator(kept: (Int) -> Boolean = { true }): FieldEstimator {
        val fresh = checkNotNull(MissionRecovery().apply { line(header) }.recovered()).estimator
        for (i in events.indices) if (events[i].value.isNaN() || kept(i)) fresh.update(events[i])
        return fresh
    }

    private fun firstSteps(lines: List<String>, steps: List<Int>, found: List<List<Reading>>): List<Int> {
        val first = HashMap<Reading, Int>()
        for ((i, line) in lines.withIndex()) {
            if ("\"reading\":" !in line) continue
            for (match in READING.findAll(line)) first.putIfAbsent(numbers(match.groupValues[1], 0.0), steps[i])
        }
        return found.flatMapIndexed { i, list -> list.map { first[it] ?: steps[i] } }
    }

    private fun events(line: String): List<Reading> {
        if ("\"pass\":[" in line) return listOf(numbers(line.substringAfter("\"pass\":["), Double.NaN))
        val list = line.substringAfter("\"taken\":[[", "").substringBefore("]]", "")
        return list.split('[').filter { it.isNotBlank() }.map { numbers(it, 0.0) }
    }

    private fun numbers(text: String, value: Double): Reading {
        val all = text.substringBefore(']').split(',').filter { it.isNotBlank() }.map { it.toDouble() }
        val known = if (all.size > 4) Conditions(mapOf(Conditions.POSITION_DEVIATION to all[4])) else Conditions.NONE
        return Reading(BoatTime(all[0]), Position(all[1], all[2]), if (value.isNaN()) value else all[3], known)
    }

    companion object {
        private val READING = Regex("\\[([-0-9.E]+,[-0-9.E]+,[-0-9.E]+(?:,[-0-9.E]+){1,2})]")

        /** Cells in which the two differ in any bit. */
        fun differences(one: FieldMap, other: FieldMap): Int = (0 until one.grid.size).count {
            one.value(it).toRawBits() != other.value(it).toRawBits() ||
                one.lower(it).toRawBits() != other.lower(it).toRawBits() ||
                one.upper(it).toRawBits() != other.upper(it).toRawBits() ||
                one.readings(it) != other.readings(it) ||
                one.visits(it) != other.visits(it)
        }
    }
}
