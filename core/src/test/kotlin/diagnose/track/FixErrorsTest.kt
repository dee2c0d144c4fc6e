package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.squares
import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What the scatter of fixes says of errors that are left in a smoothed way, of a boat that goes straight on. */
class FixErrorsTest {
    private val n = 6000
    private val times = DoubleArray(n) { 2.0 * it }

    /** Errors of [deviation] m that keep to themselves for [time] s, and are new with each fix where that is 0. */
    private fun errors(deviation: Double, time: Double, seed: Long): DoubleArray {
        val random = java.util.Random(seed)
        val keep = if (time > 0) exp(-2.0 / time) else 0.0
        var now = deviation * random.nextGaussian()
        return DoubleArray(n) {
            now = keep * now + deviation * sqrt(1 - keep * keep) * random.nextGaussian()
            now
        }
    }

    private fun smoothed(east: DoubleArray, north: DoubleArray) =
        SmoothTrack.of(MeasuredSeries(times, DoubleArray(n) { it + east[it] }, north, DoubleArray(n), null))

    @Test
    fun errorsNewWithEachFixAreKnown() {
        val track = smoothed(errors(0.5, 0.0, SEED), errors(0.5, 0.0, SEED + 1))
        val likely = track.fixes.likely
        val left = sqrt(squares(track.y) / n)
        assertEquals(left, sqrt(likely[0].variance), 0.1 * left, "seed $SEED")
        // Errors that keep to themselves for a fix or more leave the fixes about a narrow parabola more alike.
        assertTrue(likely.size <= 2, "${likely.map { it.time }} s")
    }

    /** Of errors that keep to themselves only how they grow is known: the longer, the larger. */
    @Test
    fun errorsThatKeepToThemselvesAreAsLargeAsTheirTimeSays() {
        for (fixes in listOf(4.0, 16.0)) {
            val track = smoothed(errors(0.5, 2 * fixes, SEED + 2), errors(0.5, 2 * fixes, SEED + 3))
            val likely = track.fixes.likely
            assertEquals(likely.sortedBy { it.time }.map { it.variance }, likely.map { it.variance }.sorted(), "grow")
            val nearest = likely.minBy { abs(it.time - 2 * fixes) }
            // What parabolas leave of it lasts a little longer.
            assertEquals(2 * fixes, nearest.time, 0.3 * 2 * fixes, "s, seed $SEED")
            // About four standard errors of so few errors that are free of each other.
            assertEquals(0.5, sqrt(nearest.variance), 0.5 * 2 * sqrt(fixes / n) + 0.03, "m, seed $SEED")
        }
    }

    /** Fixes jitter by 0.3 m and wander by 0.5: a wide course tells the two apart, and what is left in it. */
    @Test
    fun jitterBesideErrorsThatKeepToThemselvesIsTakenApart() {
        fun both(seed: Long): DoubleArray {
            val wander = errors(0.5, 2 * WANDER, seed)
            val jitter = errors(0.3, 0.0, seed + 7)
            return DoubleArray(n) { wander[it] + jitter[it] }
        }
        val east = both(SEED + 4)
        val ahead = mapOf(Conditions.SPEED to DoubleArray(n) { 0.5 }, Conditions.HEADING to DoubleArray(n))
        val fixes = DoubleArray(n) { it + east[it] }
        val series = MeasuredSeries(times, fixes, both(SEED + 5), DoubleArray(n), null, ahead)
        val course = SmoothTrack.wider(series).last { it.fixes.reach == 25 }
        val nearest = course.fixes.likely.minBy { abs(it.fixTime - 2 * WANDER) }
        assertTrue(course.fixes.isWide && nearest.fixTime == 2 * WANDER, "seed $SEED")
        assertEquals(0.5, nearest.fixes, 0.1, "m, seed $SEED")
        val left = sqrt(squares(course.y) / n)
        assertEquals(left, sqrt(nearest.variance), 0.2 * left, "m, seed $SEED")
    }

    @Test
    fun fixesThatAreRightAreOffByNothing() {
        assertEquals(emptyList(), smoothed(DoubleArray(n), DoubleArray(n)).fixes.likely.map { it.variance })
    }

    private companion object {
        const val SEED = 83L

        /** Fixes for which errors keep to themselves. */
        const val WANDER = 16.0
    }
}
