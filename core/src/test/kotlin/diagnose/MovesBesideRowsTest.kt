package stillwater.diagnose

import org.junit.jupiter.api.Tag
import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** A bench where samples change at once, at some moment between two rows, and the sensor follows meanwhile. */
class MovesBesideRowsTest {
    /** Lags of [lags] s in a row, a row a second, the sample changed [early] s before a row, without [missing] rows then. */
    private fun bench(seed: Long, early: Double, vararg lags: Double, missing: Int = 0): MeasuredSeries {
        val random = java.util.Random(seed)
        val samples = DoubleArray(MOVES) { 4 + 8 * random.nextDouble() }
        val states = DoubleArray(lags.size) { samples[0] }
        val truth = DoubleArray(ROWS)
        val readings = DoubleArray(ROWS)
        for (step in 0 until ROWS * FINE) {
            // A row is the end of its second; the sample changes so long before the first row of a stay.
            val second = (step + 1) / FINE.toDouble()
            val sample = samples[((second + early - 1) / STAY).toInt().coerceIn(0, MOVES - 1)]
            for (k in lags.indices) {
                val input = if (k == 0) sample else states[k - 1]
                states[k] += (1 - exp(-1 / (FINE * lags[k]))) * (input - states[k])
            }
            if (step % FINE == FINE - 1) {
                truth[step / FINE] = sample
                readings[step / FINE] = states.last() + NOISE * random.nextGaussian()
            }
        }
        val still = DoubleArray(ROWS)
        val isRead = BooleanArray(ROWS) { it % STAY >= missing || it < STAY }
        val times = DoubleArray(ROWS) { it.toDouble() }
        return MeasuredSeries(times, still, still, readings, truth, isRead = isRead)
    }

    private fun assertConsistent(seed: Long, early: Double, missing: Int) {
        val result = Diagnosis(bench(seed, early, 12.0, missing = missing)).run()
        val case = "seed $seed, $early s before a row, $missing rows missing"
        assertIs<Verdict.Consistent>(result.verdict, case)
        assertEquals(12.0, result.baseline.parameters.first().value, 0.1, case)
    }

    @Test
    fun aMomentBetweenRowsIsNoCause() {
        assertConsistent(1, early = 0.1, missing = 10)
        assertConsistent(2, early = 0.35, missing = 0)
    }

    @Test
    @Tag("long")
    fun norIsAnotherMoment() {
        assertConsistent(1, early = 0.1, missing = 0)
        assertConsistent(2, early = 0.35, missing = 10)
        for (missing in listOf(0, 10)) assertConsistent(3, early = 0.9, missing = missing)
    }

    @Test
    @Tag("long")
    fun norIsItADeadTimeBesideASecondLag() {
        for ((seed, early) in listOf(4L to 0.0, 5L to 0.1, 6L to 0.6)) {
            val result = Diagnosis(bench(seed, early, 12.0, 4.0)).run()
            val case = "seed $seed, $early s before a row"
            val named = assertIs<Verdict.Named>(result.verdict, case).causes
            assertEquals(listOf(Cause.SECOND_ORDER_RESPONSE), named, case)
            val second = result.effects.single().parameters.first { it.name == "second_time_constant_s" }.value
            assertTrue(second in 3.7..4.3, "$second s, $case")
        }
    }

    private companion object {
        const val MOVES = 10
        const val STAY = 120
        const val ROWS = MOVES * STAY
        const val FINE = 20
        const val NOISE = 0.01
    }
}
