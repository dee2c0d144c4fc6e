package stillwater.hidden

import stillwater.diagnose.ChannelLags
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import java.nio.file.Files
import java.nio.file.Path
import java.util.Locale

/** One interval of 95 %, and what it should hold; [lower] is NaN where none was given. */
internal class HiddenInterval(val truth: Double, val found: Double, val lower: Double, val upper: Double) {
    val isGiven: Boolean get() = !lower.isNaN()
    val holds: Boolean get() = truth in lower..upper

    /** How far off [found] is, in half widths of the interval on the side of [truth]. */
    val off: Double get() = if (truth > found) (truth - found) / (upper - found) else (truth - found) / (found - lower)
}

/** Whether intervals of a lag without a reference hold the true one as often as they say. */
internal object HiddenIntervals {
    private fun series(case: HiddenCase, file: Path): MeasuredSeries {
        case.write(file)
        val rows = Files.readAllLines(file).drop(1).map { line -> line.split(",").map { it.toDouble() } }
        fun column(k: Int) = DoubleArray(rows.size) { rows[it][k] }
        return MeasuredSeries(column(0), column(1), column(2), column(3), null)
    }

    /** The interval of the time constant of a sensor that has one, and nothing else; null where [seed] hides more. */
    fun timeConstant(seed: Long, file: Path): HiddenInterval? {
        val case = HiddenCase(seed, withReference = false)
        if (case.truth.effects.isNotEmpty()) return null
        val estimate = Diagnosis(series(case, file)).run().baseline.parameters.first { it.name == "time_constant_s" }
        val reach = checkNotNull(estimate.interval) { "a time constant without an interval" }
        return HiddenInterval(case.truth.timeConstant, estimate.value, reach.lower, reach.upper)
    }

    /** The same of a dead time in place of the lag. */
    fun deadTime(seed: Long, file: Path): HiddenInterval {
        val case = HiddenCase(seed, withReference = false, isDelay = true)
        val lag = ChannelLags.of(series(case, file), "value", emptyMap()).channels.first()
        val reach = lag.interval
        return HiddenInterval(
            // What slow waves are late by.
            case.delay + case.step,
            lag.delay,
            reach?.lower ?: Double.NaN,
            reach?.upper ?: Double.NaN,
        )
    }
}

/** `FIRST COUNT time-constant|dead-time`: how many intervals hold the truth. */
fun main(arguments: Array<String>) {
    val first = arguments[0].toLong()
    val file = Files.createTempFile("hidden-intervals", ".csv")
    val all = (first until first + arguments[1].toLong()).mapNotNull { seed ->
        val interval = if (arguments[2] == "dead-time") {
            HiddenIntervals.deadTime(seed, file)
        } else {
            HiddenIntervals.timeConstant(seed, file)
        }
        interval?.also {
            val numbers = listOf(it.truth, it.found, it.lower, it.upper, it.off)
            System.err.println("$seed\t" + numbers.joinToString("\t") { number -> "%.3f".format(Locale.ROOT, number) })
        }
    }
    val given = all.filter { it.isGiven }
    println("${given.count { it.holds }} of ${given.size} intervals hold the true ${arguments[2]}; ${all.size} logs")
    Files.delete(file)
}
