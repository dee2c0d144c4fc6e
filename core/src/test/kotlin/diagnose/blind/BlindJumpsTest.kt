package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Term
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import kotlin.math.abs
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Jumps of the readings beside noise that wanders, which show at their own rows alone, and beside noise that does not. */
class BlindJumpsTest {
    private val n = 900
    private val track = CrossingTrack(n)
    private val times = track.times
    private val x = track.x
    private val y = track.y

    /**
     * A lag of 4 s, with which readings are off by [offset] in the rows [off]; [wander] is how far noise wanders besides, the
     * rest of it has a deviation of 0.005.
     */
    private fun trials(offset: Double, off: IntRange, wander: Double): Pair<BlindTrials, BlindJumps> {
        val truth = DoubleArray(n) { sin(x[it] / 4) + sin(y[it] / 5 + 1) }
        val random = java.util.Random(SEED)
        var state = truth[0]
        var wandering = 0.0
        val values = DoubleArray(n) { i ->
            state += 0.22 * (truth[i] - state)
            wandering = KEPT * wandering + wander * sqrt(1 - KEPT * KEPT) * random.nextGaussian()
            state + wandering + 0.005 * random.nextGaussian() + if (i in off) offset else 0.0
        }
        val series = MeasuredSeries(times, x, y, values, null)
        val modes = WaterModes.flat(series, SmoothTrack.of(series), MOST, SHORTEST)
        val share = if (wander > 0) 0.95 else 0.0
        val noise = BlindNoise(CorrelatedNoise(times, share, 30.0, BooleanArray(n) { true }), DoubleArray(n) { 1.0 })
        val search = BlindSearch(series)
        val found = search.settled(emptyList(), doubleArrayOf(4.0, 1.0, 0.0, 0.0), noise, DoubleArray(0), ROUNDS, modes)
        val trials = BlindTrials(search, found)
        return trials to BlindJumps(found, trials.residual)
    }

    /** The best jumps of readings off by [offset] in the middle third of the log. */
    private fun jumps(offset: Double) =
        trials(offset, FIRST until SECOND, wander = 0.02).first.attempt(Term(Cause.OFFSET_STEPS))

    @Test
    fun theyAreFoundToTheRow() {
        val found = jumps(offset = 0.08)
        assertEquals(listOf(FIRST - 0.5, SECOND - 0.5), checkNotNull(found.term).times, "seed $SEED")
        assertTrue(found.pValue < 1e-6, "${found.pValue}, seed $SEED")
        val numbers = checkNotNull(found.point).numbers.takeLast(2)
        assertTrue(abs(numbers[0] - 0.08) < 0.01 && abs(numbers[1] + 0.08) < 0.01, "$numbers, seed $SEED")
    }

    @Test
    fun whereThereIsNoneTheBestPlaceIsChance() {
        val none = jumps(offset = 0.0)
        assertTrue(none.pValue > 0.05, "${none.pValue}, seed $SEED")
    }

    /**
     * Readings that are off for 24 rows by four deviations of the noise: what was before and what is after agree, so that the
     * best place of one jump gains less than half of what two do.
     */
    @Test
    fun twoThatUndoEachOtherAreFoundWhereNeitherIsAlone() {
        val off = FIRST until FIRST + 24
        val (trials, places) = trials(offset = 0.02, off, wander = 0.0)
        val found = trials.attempt(Term(Cause.OFFSET_STEPS))
        assertEquals(listOf(off.first - 0.5, off.last + 0.5), checkNotNull(found.term).times, "seed $SEED")
        assertTrue(found.pValue < 1e-3, "${found.pValue}, seed $SEED")
        val one = checkNotNull(places.best(trials.residual, emptyList()))
        val column = places.column(one)
        val alone = dot(column, trials.residual).let { it * it } / squares(column)
        val both = Evidence.orthonormal(checkNotNull(found.term).times.map(places::column))
            .sumOf { column -> dot(column, trials.residual).let { it * it } }
        assertTrue(alone < both / 2, "$alone of $both, seed $SEED")
    }

    @Test
    fun heavyTailsOfWhatIsLeftCountAgainstThem() {
        val random = java.util.Random(SEED)
        val even = DoubleArray(1000) { random.nextGaussian() }
        assertTrue(BlindJumps.tails(even, 40.0) < 1.4, "${BlindJumps.tails(even, 40.0)}, seed $SEED")
        val uneven = DoubleArray(1000) { even[it] * if (it % 25 == 0) 4.0 else 1.0 }
        assertTrue(BlindJumps.tails(uneven, 40.0) > 2.0, "${BlindJumps.tails(uneven, 40.0)}, seed $SEED")
    }

    private companion object {
        const val SEED = 20261124L
        const val KEPT = 0.97

        /** Neither is a place that an even search of so many looks at. */
        const val FIRST = 311
        const val SECOND = 593
        const val MOST = 150
        const val ROUNDS = 5
        const val SHORTEST = 15.0
    }
}
