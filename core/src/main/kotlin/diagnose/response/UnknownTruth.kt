package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.median
import stillwater.diagnose.noise.Shocks
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * What a reference does not say of the truth between its rows: gaps in the log, and moves of a probe or sharp fronts
 * that are over within a row or two.
 *
 * What the sensor has seen there leaves it in a state that the model cannot know; that fades with the lag. To the noise
 * it is a second process, at rest but for a shock of known size before each such row.
 *
 * @property isGap whether the step before a row is too long for the truth to be guessed, length n.
 * @property isBroken whether no smooth curve goes through the step before a row, length n; gaps included.
 * @property isSharp whether the truth hardly moves but in such steps, as where samples are changed at once on a bench.
 * @property late how much later than the reference the readings show the truth, s, as far as was asked.
 */
internal class UnknownTruth private constructor(
    val isGap: BooleanArray,
    val isBroken: BooleanArray,
    val isSharp: Boolean,
    private val doubts: DoubleArray,
    private val guesses: DoubleArray,
    private val between: DoubleArray,
    private val changes: TruthChanges,
    private val times: DoubleArray,
    val late: Double = 0.0,
) {
    private val period by lazy { MeasuredSeries.period(times) }

    /** Whether so many steps are in doubt that the log says little of how the reading follows the truth. */
    val isMostly: Boolean get() = isBroken.count { it } > OFTEN * isBroken.size

    /** What to say of gaps; null without any. */
    fun words(): String? {
        val gaps = isGap.count { it }
        if (gaps == 0) return null
        val where = if (gaps == 1) "after a gap" else "after $gaps gaps"
        return "What the sensor saw while nothing was logged is unknown. What is left of it $where counts neither " +
            "for nor against any cause, but is in the residuals' root mean square."
    }

    /** Whether the truth beside row [i] is in doubt, so that a reading there may be far off without being wrong. */
    fun isInDoubt(i: Int): Boolean = (maxOf(i - 1, 0)..minOf(i + 1, doubts.size - 1)).any { doubts[it] > 0 }

    /**
     * Shocks to the reading of a [sensor] under noise of [spread], sensor units, where [doubt] is taken; those of gaps, of missing
     * rows and beyond the log alone if it has the truth held over each step, but that sharp steps may come a little beside a
     * row. What it saw in a gap goes on to reach it after a delay, and from a second lag. Null where nothing is in doubt.
     */
    fun shocks(sensor: Shaken, spread: Double, doubt: Doubt): Shocks? {
        val keep = DoubleArray(times.size) { i -> if (i == 0) 1.0 else kept(i, sensor.timeConstants) }
        val beside = if (isSharp) BESIDE_ROW else 0.0
        val beyond = if (doubt.isBeyond) sensor.beyond else null
        val doubts = if (isSharp && late == 0.0) arriving(sensor) else doubts
        var gap = -1
        val variance = DoubleArray(times.size) { i ->
            if (isGap[i]) gap = i
            val off = if (isGap[i]) {
                doubts[i]
            } else {
                val after = if (gap < 0) 0.0 else doubts[gap] * reaching(times[i] - times[gap], sensor)
                val within = if (doubt.between == null) doubts[i] else doubt.between * between[i]
                val here = maxOf(guesses[i], if (sensor.isHeld) beside * doubts[i] else within)
                val outside = if (beyond == null || i == 0) 0.0 else maxOf(beyond[i - 1], beyond[i])
                (1 - keep[i]) * maxOf(here, after, sensor.swing?.get(i) ?: 0.0, changes.over(outside / period))
            }
            val shock = sensor.gain * off / spread
            if (abs(shock) > LEAST) shock * shock else 0.0
        }
        return if (variance.any { it > 0 }) Shocks(variance, keep) else null
    }

    /** The same of a sensor with one lag of [timeConstant] s and no delay. */
    fun shocks(timeConstant: Double, gain: Double, spread: Double, isHeld: Boolean): Shocks? =
        shocks(Shaken(DoubleArray(times.size) { timeConstant }, gain, isHeld), spread, Doubt())

    private fun kept(i: Int, timeConstants: DoubleArray) = exp(-(times[i] - times[i - 1]) / timeConstants[i])

    /** By how much what the truth may be off within a usual step shakes readings with a lag of [timeConstants] s before each row. */
    fun usual(timeConstants: DoubleArray): Double =
        median(DoubleArray(times.size - 1) { i -> (1 - kept(i + 1, timeConstants)) * between[i + 1] })

    /** The same of a log that has more rows, at [times], s: each row is the one of [rows] there. */
    fun among(rows: IntArray, times: DoubleArray): UnknownTruth {
        fun of(column: BooleanArray) = BooleanArray(times.size).also { for (i in rows.indices) it[rows[i]] = column[i] }
        fun of(column: DoubleArray) = DoubleArray(times.size).also { for (i in rows.indices) it[rows[i]] = column[i] }
        return UnknownTruth(
            of(isGap),
            of(isBroken),
            isSharp,
            of(doubts),
            of(guesses),
            of(between),
            changes,
            times,
            late,
        )
    }

    /**
     * What is in doubt of sharp steps where it reaches the lag of a [sensor]: after its delay, in the two rows that this
     * falls in, in each by its part, and from a second lag for as long as that takes; of gaps as it is.
     */
    private fun arriving(sensor: Shaken): DoubleArray {
        if (sensor.delay == 0.0 && sensor.second == 0.0) return doubts
        val out = DoubleArray(times.size) { if (isGap[it]) doubts[it] else 0.0 }
        for (row in 1 until times.size) {
            if (isGap[row] || !(doubts[row] > 0)) continue
            val from = times[row - 1] + sensor.delay
            val to = times[row] + sensor.delay
            var i = times.binarySearch(from).let { if (it >= 0) it + 1 else -it - 1 }.coerceAtLeast(1)
            while (i < times.size && !isGap[i]) {
                val overlap = minOf(times[i], to) - maxOf(times[i - 1], from)
                val part = maxOf(overlap / (to - from), 0.0)
                val later = if (sensor.second > 0) exp(-maxOf(0.0, times[i - 1] - from) / sensor.second) else 0.0
                val share = maxOf(part, later)
                if (share < SEEN) break
                out[i] = maxOf(out[i], share * doubts[row])
                i++
            }
        }
        return out
    }

    /** Share of what a [sensor] saw in a gap that reaches its lag so long [after] it, s. */
    private fun reaching(after: Double, sensor: Shaken): Double = when {
        after <= sensor.delay -> 1.0
        sensor.second > 0 -> exp(-(after - sensor.delay) / sensor.second)
        else -> 0.0
    }

    /**
     * The same where readings show the truth [late] s later than the reference does, known to a row: they are shaken as
     * much later.
     */
    fun seen(late: Double): UnknownTruth = if (late == 0.0) this else toARow(late)

    /** The same where readings show the truth [late] s later than the reference, each way known to a row. */
    fun toARow(late: Double = 0.0): UnknownTruth {
        val moved = DoubleArray(times.size) { if (isGap[it]) doubts[it] else 0.0 }
        for (row in 1 until times.size) {
            if (isGap[row] || !(doubts[row] > 0)) continue
            var i = times.binarySearch(times[row - 1] + late - period).let { if (it >= 0) it + 1 else -it - 1 }
            while (i < times.size && (i == 0 || times[i - 1] < times[row] + late + period)) {
                moved[i] = maxOf(moved[i], doubts[row])
                i++
            }
        }
        return UnknownTruth(isGap, isBroken, isSharp, moved, guesses, between, changes, times, late)
    }

    companion object {
        /** Nothing is in doubt in [series]. */
        fun none(series: MeasuredSeries) =
            UnknownTruth(
                BooleanArray(series.size),
                BooleanArray(series.size),
                false,
                DoubleArray(series.size),
                DoubleArray(series.size),
                DoubleArray(series.size),
                TruthChanges.of(series),
                series.times,
            )

        /**
         * What gaps in [series] leave open where there is no reference: what was passed there is anybody's guess, and may
         * have been any of the readings. Null where there are none.
         */
        fun ofGaps(series: MeasuredSeries): UnknownTruth? {
            val isGap = gaps(series)
            if (isGap.none { it }) return null
            val spread = deviation(series.values)
            val doubts = DoubleArray(series.size) { if (isGap[it]) spread else 0.0 }
            val none = DoubleArray(series.size)
            return UnknownTruth(isGap, isGap, false, doubts, none, none, TruthChanges.of(series), series.times)
        }

        private fun gaps(series: MeasuredSeries) =
            BooleanArray(series.size) { it > 0 && series.times[it] - series.times[it - 1] > GAP * series.period }

        /** What the reference of [series] leaves open. */
        fun of(series: MeasuredSeries): UnknownTruth {
            val truth = series.reference ?: return none(series)
            val n = series.size
            val times = series.times
            val isGap = gaps(series)
            val near = ReferenceGaps.errors(times, truth, 1, isGap)
            val within = within(near, ReferenceGaps.errors(times, truth, 2, isGap))
            val usual = median(within)
            val spread = deviation(truth)
            val steps = DoubleArray(n) { if (it == 0 || isGap[it]) 0.0 else abs(truth[it] - truth[it - 1]) }
            val far = maxOf(SUDDEN * median(steps), ROUNDED * rounding(truth))
            val isBroken = BooleanArray(n) { i ->
                val beside = maxOf(steps.getOrElse(i - 2) { 0.0 }, steps.getOrElse(i + 2) { 0.0 })
                isGap[i] || (steps[i] > far && steps[i] > STEEPER * beside)
            }
            val sudden = DoubleArray(n) { if (isBroken[it]) steps[it] else 0.0 }
            val isSharp = squares(sudden) > MOSTLY * squares(steps)
            // Between two sharp steps the truth is foretold from what lies between them alone.
            val calm = if (isSharp) {
                within(ReferenceGaps.errors(times, truth, 1, isBroken), ReferenceGaps.errors(times, truth, 2, isBroken))
            } else {
                within
            }
            val between = DoubleArray(n) { i ->
                val errors = if (isBroken[i]) within else calm
                if (i == 0 || isGap[i]) 0.0 else maxOf(errors[i - 1], errors[i])
            }
            val doubts = DoubleArray(n) { i ->
                when {
                    isGap[i] -> spread
                    between[i] > UNUSUAL * usual && between[i] > ROUNDING * spread -> between[i]
                    else -> 0.0
                }
            }
            // Where a row is missing the truth there is as far off as where one was left out to foretell it.
            val guesses = DoubleArray(n) { i ->
                val isLong = i > 0 && !isGap[i] && times[i] - times[i - 1] > LONG * series.period
                val isGuess = series.isGuessed?.get(i) == true
                val guess = if (isLong || isGuess) most(near, i, if (isGuess) 2 else 1) else 0.0
                if (guess > ROUNDING * spread) guess else 0.0
            }
            val changes = TruthChanges.of(series)
            return UnknownTruth(isGap, isBroken, isSharp, doubts, guesses, between, changes, times)
        }

        /**
         * How far the truth may be off a cubic within the steps beside each row: the error of foretelling rows near by
         * from those beside them, over how much faster than twice as far it is.
         */
        private fun within(near: DoubleArray, far: DoubleArray) = DoubleArray(near.size) { i ->
            val one = most(near, i, 1)
            if (one > 0) one / (most(far, i, 2) / one).coerceIn(1.0, ReferenceGaps.FASTEST) else 0.0
        }

        /** What slow water moves by where it is rounded, which stands still in most rows; 0 where a few levels are all. */
        private fun rounding(truth: DoubleArray): Double =
            Resolution.of(truth).takeIf { truth.max() - truth.min() > LEVELS * it } ?: 0.0

        private fun most(errors: DoubleArray, i: Int, reach: Int): Double {
            var most = 0.0
            for (k in maxOf(i - reach, 0)..minOf(i + reach, errors.size - 1)) most = maxOf(most, errors[k])
            return most
        }

        /** Standard deviation of [truth]. */
        fun deviation(truth: DoubleArray): Double {
            val mean = truth.average()
            return sqrt(truth.sumOf { (it - mean) * (it - mean) } / truth.size)
        }

        /** Of what is in doubt of a sharp step: less of it is not followed through a second lag. */
        private const val SEEN = 1e-3

        /** A step longer than so many usual ones is a gap. */
        private const val GAP = 4.0

        /** A step longer than so many usual ones has a row missing. */
        private const val LONG = 1.75
        private const val UNUSUAL = 4.0

        /** Where the truth stands still a cubic through it is off by errors of arithmetic. */
        private const val ROUNDING = 1e-9
        private const val SUDDEN = 12.0
        private const val STEEPER = 3.0

        /** Steps of a rounded reference that are no sudden ones. */
        private const val ROUNDED = 3.0

        /** Steps from the lowest to the highest of a reference that is rounded; with fewer they are its own. */
        private const val LEVELS = 30

        private const val OFTEN = 0.08

        /** Of a row, by which sharp steps of a truth that is held over each may come beside one. */
        private const val BESIDE_ROW = 0.1

        /** Of the squares of all steps: a truth of which sudden ones have more is sharp. */
        private const val MOSTLY = 0.9

        /** Shocks below this, in standard deviations of the noise, are left out. */
        private const val LEAST = 0.1
    }
}
