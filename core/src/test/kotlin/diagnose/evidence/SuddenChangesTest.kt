package stillwater.diagnose.evidence

import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertIs
import kotlin.test.assertNull

class SuddenChangesTest {
    private val random = Random(SEED)

    @Test
    fun whatNoiseLeavesIsNone() {
        assertNull(SuddenChanges.words(DoubleArray(2000) { random.nextGaussian() }), "seed $SEED")
        // Student's t of three degrees of freedom: more tails than any probe's noise.
        val tailed = DoubleArray(2000) {
            random.nextGaussian() / sqrt(List(3) { random.nextGaussian() }.sumOf { it * it } / 3)
        }
        assertNull(SuddenChanges.words(tailed), "seed $SEED")
    }

    @Test
    fun aFewChangesMayBeJumps() {
        val left = DoubleArray(2000) { random.nextGaussian() }
        for (row in listOf(200, 900, 1500, 1800)) left[row] += 200.0
        assertNull(SuddenChanges.words(left), "seed $SEED")
        left[1000] -= 200.0
        assertContains(checkNotNull(SuddenChanges.words(left)), "change suddenly 5 times")
    }

    /** Dips of some deviations, too small to be most of what is left. */
    @Test
    fun changesThatNearlyAllGoOneWayAreNoNoise() {
        fun left(upward: Int): DoubleArray {
            val left = DoubleArray(2000) { random.nextGaussian() }
            for (k in 0 until 24) left[50 + 80 * k] = if (k < upward) 9.0 else -9.0
            return left
        }
        assertContains(checkNotNull(SuddenChanges.words(left(0))), "change suddenly 24 times downward, and come back")
        assertContains(checkNotNull(SuddenChanges.words(left(22))), "24 times, all but 2 of them upward, and come back")
        assertNull(SuddenChanges.words(left(8)), "seed $SEED")
    }

    @Test
    fun whatComesBackInARowIsOneChange() {
        val left = DoubleArray(2000) { random.nextGaussian() }
        for (row in listOf(200, 500, 900, 1500, 1800)) {
            left[row] += 200.0
            left[row + 1] -= 150.0
        }
        assertContains(checkNotNull(SuddenChanges.words(left)), "change suddenly 5 times")
    }

    /** Bubbles that fade in four seconds: noise that wanders would take them all, and nothing would be said. */
    @Test
    fun bubblesAreNoNoise() {
        val track = CrossingTrack(900)
        val values = track.shown(5.0).map { it + 0.005 * random.nextGaussian() }.toDoubleArray()
        for (row in List(15) { 20 + random.nextInt(860) }) {
            for (k in row until minOf(row + 20, 900)) values[k] -= 0.8 * exp((row - k) / 4.0)
        }
        val verdict = Diagnosis(MeasuredSeries(track.times, track.x, track.y, values, null)).run().verdict
        assertContains(assertIs<Verdict.Unexplained>(verdict).what, "come back slowly, as with bubbles")
    }

    private companion object {
        const val SEED = 20261126L
    }
}
