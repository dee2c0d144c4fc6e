package stillwater.io

import org.hipparchus.stat.StatUtils
import stillwater.report.counted
import java.util.Locale
import kotlin.math.abs
import kotlin.math.roundToLong

/**
 * What the times of a log were cut to, where that is so coarse that rows share a time or take turns of one unit more
 * and one less, as those of a logger of 5 Hz do that writes whole seconds.
 *
 * @property unit what all times are multiples of, s. @property most rows that may share a time; more, and the clock
 * stood still.
 */
internal class TimeRounding(val unit: Double, val most: Int) {
    /** The unit, for people. */
    val words: String
        get() = when (unit) {
            1.0 -> "whole seconds"
            MINUTE -> "whole minutes"
            else -> "multiples of ${"%.3g".format(Locale.ROOT, unit)} s"
        }

    /** What to tell of a log in which [shared] rows have the time of the row before. */
    fun note(shared: Long): String {
        val proof = if (shared > 0) "${counted(shared, "row")} of the time of the row before" else "uneven steps"
        return "times are $words ($proof): rows are spread over what was cut off as evenly as they can be, and " +
            "effects as short as that may be the clock's"
    }

    /** Times in units from the first of a log, of which none goes back. */
    private class Steps(times: List<Double>, unit: Double) {
        private val inUnits = times.zipWithNext { a, b -> ((b - a) / unit).roundToLong() }.filter { it >= 0 }
        private val sorted = inUnits.filter { it > 0 }.sorted()

        /** The usual step to a later time. */
        val usual = if (sorted.isEmpty()) 0 else sorted[sorted.size / 2]

        /** How often a row has the time of the one before. */
        val repeats = inUnits.count { it == 0L }

        /** The usual number of rows that share a time that is shared. */
        val shared: Int
            get() {
                val sizes = ArrayList<Int>()
                var size = 1
                for (step in inUnits + 1L) {
                    if (step == 0L) {
                        size++
                    } else {
                        if (size > 1) sizes += size
                        size = 1
                    }
                }
                return sizes.sorted()[sizes.size / 2]
            }

        /** Whether nearly all steps are the usual one. */
        val areEven: Boolean get() = inUnits.count { it != usual } <= MOST_OTHERS * inUnits.size

        /**
         * Whether steps are of two lengths, a unit apart, of which the rarer comes much more evenly than by chance:
         * rows that were lost leave longer steps, too, but do not keep time.
         */
        fun areRegular(): Boolean {
            if (usual !in 1..LONGEST) return false
            val others = listOf(usual - 1, usual + 1).filter { it > 0 }
            val other = others.maxByOrNull { step -> inUnits.count { it == step } } ?: return false
            if (inUnits.count { it != usual && it != other } > MOST_OTHERS * inUnits.size) return false
            val gaps = inUnits.indices.filter { inUnits[it] == other }.zipWithNext { a, b -> (b - a).toDouble() }
            if (gaps.size < FEWEST_GAPS) return false
            val lengths = gaps.toDoubleArray()
            val mean = StatUtils.mean(*lengths)
            // By chance their lengths are distributed geometrically.
            return StatUtils.variance(*lengths) < REGULAR * mean * (mean - 1)
        }
    }

    companion object {
        private const val MINUTE = 60.0

        /** So often a time must come twice: one or two may be a fault of the log. */
        private const val FEWEST_REPEATS = 3

        /** Steps of more units are hardly changed by what was cut off. */
        private const val LONGEST = 20
        private const val FEWEST_GAPS = 10

        /** Part of the steps that may be of another length, as rows that were lost leave. */
        private const val MOST_OTHERS = 0.05

        /** Least ratio of the variance of gaps to that of chance that may be chance: less comes once in 3000 times. */
        private const val REGULAR = 0.1

        /** Part of a unit to which times are multiples of it: times since 1970 have no more digits. */
        private const val TOLERANCE = 1e-3
        private const val MOST_OF_USUAL = 3
        private const val DIGITS = 7

        /**
         * How the times of a log are rounded whose head has [times], s, written as [form]; null where they are not.
         *
         * @param clock what they were made of in a Sea-Bird file, whose days or minutes have so many digits; null in others.
         * @param isRead whether the row with each of [times] has a reading: where these rows keep time, uneven steps between
         *   them are those from one sensor to the next.
         */
        fun of(
            times: List<Double>,
            form: TimeForm,
            clock: SeaBirdHeader.Clock? = null,
            isRead: (Int) -> Boolean = { true },
        ): TimeRounding? {
            val known = times.filter { it.isFinite() }
            val zero = clock?.zero ?: form.zero
            val units = (units(form) + digits(clock?.factor)).distinct().sortedDescending()
            // All of a short log may lie near a whole day.
            val span = (known.maxOrNull() ?: 0.0) - (known.minOrNull() ?: 0.0)
            val unit = units.firstOrNull { unit -> unit <= span && known.all { isMultiple(it - zero, unit) } }
                ?: return null
            val steps = Steps(known, unit)
            // Rows that come at once and then none for several units have waited for the one who wrote the time.
            if (steps.repeats >= FEWEST_REPEATS && steps.usual == 1L) {
                return TimeRounding(unit, MOST_OF_USUAL * (steps.shared + 1))
            }
            val ofReadings = Steps(times.filterIndexed { i, time -> isRead(i) && time.isFinite() }, unit)
            val isOfSensors = ofReadings.areEven && !steps.areEven
            return if (steps.areRegular() && !isOfSensors) TimeRounding(unit, MOST_OF_USUAL) else null
        }

        /** Units that times may be cut to, s, the coarsest first. */
        private fun units(form: TimeForm): List<Double> {
            val ofClock = listOf(MINUTE, 1.0, 0.1, 0.01, 0.001)
            if (form.kind != TimeForm.Kind.NUMBER) return ofClock
            return digits(form.factor)
        }

        /** What the digits of a number of units of [factor] s stand for, s. */
        private fun digits(factor: Double?) = generateSequence(factor) { it / 10 }.take(DIGITS + 1).toList()

        private fun isMultiple(time: Double, unit: Double): Boolean {
            val units = time / unit
            return abs(units - units.roundToLong()) < TOLERANCE
        }
    }
}
