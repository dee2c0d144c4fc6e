package stillwater.estimate

import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** A reference that jumps off and comes back, while the readings go on as before, has failed there. */
class FailedReferenceTest {
    private val n = 600
    private val random = java.util.Random(4)
    private val water = DoubleArray(n) { 12 + sin(it / 40.0) + 0.003 * random.nextGaussian() }

    /** What a lag of 8 rows shows. */
    private fun readings(truth: DoubleArray): DoubleArray {
        var state = truth[0]
        return DoubleArray(n) { i ->
            state += (1 - exp(-1 / 8.0)) * (truth[i] - state)
            state + 0.005 * random.nextGaussian()
        }
    }

    @Test
    fun rowsInWhichItFailsAreTold() {
        val failed = listOf(70, 71, 300, 551, 553, 554, 556, 598, 599)
        val reference = water.copyOf().also { all -> failed.forEach { all[it] = 12 + 40 * random.nextGaussian() } }
        assertEquals(failed, FailedReference.rows(readings(water), reference))
    }

    @Test
    fun whatTheReadingsShowIsWater() {
        val plume = water.copyOf().also { all -> for (i in 200..203) all[i] += 15.0 }
        assertEquals(emptyList(), FailedReference.rows(readings(plume), plume))
    }

    @Test
    fun whatIsWithinWhatTheWaterDoesIsWater() {
        val dips = water.copyOf().also { all -> for (i in 100..500 step 100) all[i] += 1.5 }
        assertEquals(emptyList(), FailedReference.rows(readings(water), dips))
    }

    @Test
    fun movesThatStayAreWater() {
        val bench = DoubleArray(n) { (if (it / 100 % 2 == 0) 5.0 else 25.0) + 0.002 * random.nextGaussian() }
        assertEquals(emptyList(), FailedReference.rows(readings(bench), bench))
    }

    @Test
    fun rowsWithoutAReferenceAreNeverAmongThem() {
        val reference = water.copyOf()
        for (i in 100..400) reference[i] = Double.NaN
        reference[450] = 90.0
        assertEquals(listOf(450), FailedReference.rows(readings(water), reference))
    }

    @Test
    fun oneThatFailsInManyRowsSaysNothingOfWhich() {
        val reference = DoubleArray(n) { if (it % 7 == 0) 40.0 else water[it] }
        assertEquals(emptyList(), FailedReference.rows(readings(water), reference))
    }

    @Test
    fun lengthsThatDifferAreRefused() {
        assertFailsWith<IllegalArgumentException> { FailedReference.rows(DoubleArray(40), DoubleArray(41)) }
    }
}
