package stillwater.diagnose.blind

import org.junit.jupiter.api.Test
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.track.SmoothTrack
import stillwater.model.Conditions
import kotlin.math.atan2
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.sqrt
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Fixes that are off by half a metre, and by nearly as much in the next minute, beside a compass and a log's speed. */
class BlindCourseTest {
    private val n = 900
    private val track = CrossingTrack(n)

    private fun log(wander: Double): MeasuredSeries {
        val random = java.util.Random(SEED)
        val shown = track.shown(LAG)
        val values = DoubleArray(n) { shown[it] + 0.01 * random.nextGaussian() }
        val keep = exp(-1 / TIME)
        fun fixes(column: DoubleArray): DoubleArray {
            var off = wander * random.nextGaussian()
            return DoubleArray(n) {
                off = keep * off + wander * sqrt(1 - keep * keep) * random.nextGaussian()
                column[it] + off
            }
        }
        fun rate(column: DoubleArray, i: Int) = column[minOf(i + 1, n - 1)] - column[minOf(i, n - 2)]
        val conditions = mapOf(
            Conditions.SPEED to DoubleArray(n) { hypot(rate(track.x, it), rate(track.y, it)) },
            Conditions.HEADING to DoubleArray(n) { atan2(rate(track.y, it), rate(track.x, it)) },
        )
        return MeasuredSeries(track.times, fixes(track.x), fixes(track.y), values, null, conditions)
    }

    /** Root mean square of how far the way of [course] over five rows is off the boat's, m. */
    private fun error(course: SmoothTrack): Double {
        fun off(i: Int, column: DoubleArray, way: DoubleArray) = column[i + 5] - column[i] - way[i + 5] + way[i]
        val square = (0 until n - 5).sumOf { i ->
            hypot(off(i, course.x, track.x), off(i, course.y, track.y)).let { it * it }
        }
        return sqrt(square / n)
    }

    @Test
    fun readingsTellACourseThatFixesWhichWanderDoNot() {
        val series = log(WANDER)
        val search = BlindSearch(series)
        val found = search.best()
        val byFixes = error(SmoothTrack.of(series))
        assertTrue(error(search.track) < byFixes / 2, "${error(search.track)} for $byFixes, seed $SEED")
        assertEquals(search.track, found.modes.track)
    }

    /** A course with quick changes that the boat did not see leaves what depends on what was there before. */
    @Test
    fun fixesThatWanderHideNoLag() {
        val result = Diagnosis(log(WANDER)).run()
        assertTrue(result.verdict is Verdict.Consistent, "${result.verdict}, seed $SEED")
        val lag = result.baseline.parameters.first { it.name == "time_constant_s" }
        assertEquals(LAG, lag.value, 0.05 * LAG, "seed $SEED")
    }

    @Test
    fun fixesThatAreRightAreFollowed() {
        val series = log(0.0)
        val search = BlindSearch(series)
        search.best()
        assertTrue(search.track.x.contentEquals(SmoothTrack.of(series).x))
    }

    private companion object {
        const val LAG = 4.0
        const val SEED = 20261130L
        const val WANDER = 0.5

        /** s. */
        const val TIME = 60.0
    }
}
