package stillwater.estimate

import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertTrue

/** The filter alone, with a sensor that moves by 0.02 of the prior's width a second. */
class SlewFilterTest {
    private val random = java.util.Random(11)
    private var state = 0.0
    private var seconds = 0.0

    private fun SlewFilter.visit(slot: Int, truth: Double, readings: Int, interval: Double = 1.0) {
        repeat(readings) {
            seconds += interval
            val step = RATE * interval
            state += (truth - state).coerceIn(-step, step)
            take(slot, seconds, state + NOISE * random.nextGaussian())
        }
    }

    private fun started() = SlewFilter().also { it.reset(RATE, 0.03, NOISE * NOISE) }

    private fun SlewFilter.deviation(slot: Int) = sqrt(common(slot, 0.0))

    /** The way that did not happen goes at a rate of its own, which no cell's error may be told by. */
    @Test
    fun `a long visit downwards does not make cells uncertain that were reached before`() {
        val filter = started()
        filter.visit(0, 0.3, 60)
        filter.visit(1, 0.0, 60)
        val known = filter.deviation(0)
        assertTrue(known < NOISE, "$known")
        for (slot in 2..6) {
            filter.visit(slot, if (slot % 2 == 0) -0.4 else -0.1, 60)
            assertTrue(filter.deviation(0) < 2 * known, "${filter.deviation(0)} after $known, in cell $slot")
        }
    }

    @Test
    fun `one odd interval does not change what is known of a cell`() {
        val filter = started()
        filter.visit(0, 0.3, 60)
        filter.visit(1, 0.0, 30)
        val known = filter.deviation(0)
        filter.visit(1, 0.0, 1, interval = 1e-3)
        assertTrue(filter.deviation(0) < 1.5 * known, "${filter.deviation(0)} after $known")
        filter.visit(1, 0.0, 1, interval = 60.0)
        assertTrue(filter.deviation(0) > known / 1.5, "${filter.deviation(0)} after $known")
    }

    private companion object {
        const val RATE = 0.02
        const val NOISE = 0.002
    }
}
