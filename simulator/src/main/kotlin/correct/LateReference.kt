package stillwater.correct

import stillwater.estimate.CandidateResponse
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
        val middle = known.middle(MOST)
        // Behind a rate limit the water is not told by any of the responses that it is held against.
        if (middle.size < FEWEST || !series.rateLimit().isNaN()) return 0.0
        val length = series.times[middle.last()] - series.times[middle.first()]
        val longest = minOf(length / PARTS, MOST_STEPS * series.medianStep)
        // The same rows for all delays.
        val ends = ends(series, references)
        val rows = middle.filter { ends[it] >= series.times[it] + longest }
        if (rows.size < FEWEST) return 0.0
        val part = series.at(rows)

        fun taken(all: DoubleArray) = DoubleArray(rows.size) { all[rows[it]] }

        fun lag(late: Double): CandidateResponse? =
            ReferenceLearner(part, taken(earlier(series, references, late))).candidate(ResponseKind.FIRST_ORDER)

        // Not one after the other: as late as the reference is, a lag far too long may be likelier than a little less late.
        val delays = generateSequence(part.medianStep) { 2 * it }.takeWhile { it <= longest }
        var (late, best) = (sequenceOf(0.0) + delays).map { it to lag(it) }.maxBy { it.second.score() }
        if (late == 0.0) return 0.0
        var width = late / 2
        repeat(HALVINGS) {
            val (near, found) = listOf(late - width, late + width).filter { it in 0.0..longest }
                .map { it to lag(it) }.maxBy { it.second.score() }
            if (found.score() > best.score()) {
                late = near
                best = found
            }
            width /= 2
        }
        val plain = taken(references)
        val asItIs = ReferenceWater.likeliest(part, plain, ReferenceLearner.isHeld(part, plain))
        // Taken earlier, and then behind a lag, it is smoothed to both sides: where it is noise, that alone is better.
        val smoothed = SMOOTHED.maxOf { ReferenceWater.likeliest(part, taken(smoothed(references, it))) }
        val otherwise = maxOf(asItIs, smoothed)
        // Where the lag takes back what the reference was taken earlier, only noise of the reference may ask for both, and
        // between two rows that is averaged.
        val isTakenBack = (best?.response?.meanDelay ?: 0.0) in late / ALIKE..late * ALIKE
        val judged = if (isTakenBack) lag(Math.rint(late / part.medianStep) * part.medianStep) else best
        return if (2 * (judged.score() - otherwise) > CLEARLY) late else 0.0
    }

    private fun CandidateResponse?.score(): Double = this?.score ?: Double.NEGATIVE_INFINITY

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
