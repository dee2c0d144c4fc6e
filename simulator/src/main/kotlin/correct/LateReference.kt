package stillwater.correct

import stillwater.estimate.ReferenceLearner
import stillwater.estimate.ResponseKind
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.estimate.rateLimit
import stillwater.survey.Wording.Companion.duration

/**
 * A reference that is late: of a logger of its own whose clock is behind, or with a lag of its own. No sensor shows what
 * is yet to come: where the reference taken earlier and a single lag explain the readings better than any response to the
 * reference as it is, it is late.
 */
internal object LateReference {
    /** Twice a log-likelihood by which it has to be better: a rate limit beside a noisy reference had 17. */
    private const val CLEARLY = 30.0
    private const val FEWEST = 60

    /** Rows looked at, in the middle of a log. */
    private const val MOST = 2000

    /** The longest delay looked for is such a part of these, and so many of their steps. */
    private const val PARTS = 10
    private const val MOST_STEPS = 64
    private const val HALVINGS = 5

    /** A lag and a delay that differ by less than this factor may be the same. */
    private const val ALIKE = 2.0

    /** Rows to either side over which noise of the reference is taken off. */
    private val SMOOTHED = listOf(1, 2, 4)

    /**
     * By how much [references], NaN where there is none, are later than the readings of [series] need, s; 0 where that does
     * not show.
     */
    fun seconds(series: TrackSeries, references: DoubleArray, unusable: UnusableReadings): Double {
        val known = (0 until series.size).filter { references[it].isFinite() && unusable.isUsable(it) }
        val middle = known.drop(maxOf(0, (known.size - MOST) / 2)).take(MOST)
        // Behind a rate limit the water is not told by any of the responses that it is held against.
        if (middle.size < FEWEST || !series.rateLimit().isNaN()) return 0.0
        val length = series.times[middle.last()] - series.times[middle.first()]
        val longest = minOf(length / PARTS, MOST_STEPS * series.medianStep)
        // The same rows for all delays.
        val ends = ends(series, references)
        val rows = middle.filter { ends[it] >= series.times[it] + longest }
        if (rows.size < FEWEST) return 0.0
        val part = series.at(rows)

        fun candidate(taken: DoubleArray, kind: ResponseKind, held: Boolean = false) =
            ReferenceLearner(part, DoubleArray(rows.size) { taken[rows[it]] }, held).candidate(kind)

        fun score(taken: DoubleArray, kind: ResponseKind, held: Boolean = false): Double =
            candidate(taken, kind, held)?.score ?: Double.NEGATIVE_INFINITY

        fun score(late: Double) = score(earlier(series, references, late), ResponseKind.FIRST_ORDER)

        // Not one after the other: as late as the reference is, a lag far too long may be likelier than a little less late.
        val delays = generateSequence(part.medianStep) { 2 * it }.takeWhile { it <= longest }
        var (late, best) = (sequenceOf(0.0) + delays).map { it to score(it) }.maxBy { it.second }
        if (late == 0.0) return 0.0
        var width = late / 2
        repeat(HALVINGS) {
            val (near, found) = listOf(late - width, late + width).filter { it in 0.0..longest }
                .map { it to score(it) }.maxBy { it.second }
            if (found > best) {
                late = near
                best = found
            }
            width /= 2
        }
        val isHeld = ReferenceLearner.isHeld(part, DoubleArray(rows.size) { references[rows[it]] })
        val asItIs = ResponseKind.entries.maxOf { score(references, it, isHeld) }
        // Taken earlier, and then behind a lag, it is smoothed to both sides: where it is noise, that alone is better.
        val smoothed = SMOOTHED.maxOf { reach ->
            smoothed(references, reach).let { taken -> ResponseKind.entries.maxOf { score(taken, it) } }
        }
        val otherwise = maxOf(asItIs, smoothed)
        val lag = candidate(earlier(series, references, late), ResponseKind.FIRST_ORDER)?.response?.meanDelay ?: 0.0
        // Where the lag takes back what the reference was taken earlier, only noise of the reference may ask for both, and
        // between two rows that is averaged.
        val isTakenBack = lag in late / ALIKE..late * ALIKE
        val judged = if (isTakenBack) score(Math.rint(late / part.medianStep) * part.medianStep) else best
        return if (2 * (judged - otherwise) > CLEARLY) late else 0.0
    }

    /** Means of [references] over up to [reach] rows to either side; NaN where there is none. */
    private fun smoothed(references: DoubleArray, reach: Int) = DoubleArray(references.size) { row ->
        if (references[row].isNaN()) return@DoubleArray Double.NaN
        (maxOf(0, row - reach)..minOf(references.size - 1, row + reach)).map { references[it] }
            .filter { it.isFinite() }.average()
    }

    /** Time, s, until which rows with one of [references] follow each row without a gap; minus infinity beside none. */
    private fun ends(series: TrackSeries, references: DoubleArray): DoubleArray {
        val ends = DoubleArray(series.size) { Double.NEGATIVE_INFINITY }
        var after = -1
        for (row in series.size - 1 downTo 0) {
            if (!references[row].isFinite()) continue
            val isJoined = after >= 0 && series.times[after] - series.times[row] <= series.gapLimit
            ends[row] = if (isJoined) ends[after] else series.times[row]
            after = row
        }
        return ends
    }

    /** What is said of references that were taken [late], s, earlier. */
    fun words(late: Double): String =
        "the readings are ahead of the reference by ${duration(late)}: its clock is behind, or it has a lag of its " +
            "own; it was taken that much earlier"

    /** [references] of [series] as they are [late], s, after each row: NaN where that is beside none. */
    fun earlier(series: TrackSeries, references: DoubleArray, late: Double): DoubleArray {
        if (late == 0.0) return references
        val known = (0 until series.size).filter { references[it].isFinite() }
        var next = 0
        return DoubleArray(series.size) { row ->
            val time = series.times[row] + late
            while (next < known.size && series.times[known[next]] < time) next++
            if (next < known.size && series.times[known[next]] == time) return@DoubleArray references[known[next]]
            if (next == 0 || next == known.size) return@DoubleArray Double.NaN
            val before = known[next - 1]
            val after = known[next]
            val span = series.times[after] - series.times[before]
            if (span > series.gapLimit) return@DoubleArray Double.NaN
            references[before] + (time - series.times[before]) / span * (references[after] - references[before])
        }
    }
}
