package stillwater.io

import org.junit.jupiter.api.Test
import kotlin.math.floor
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Rounded times are told from exact ones, and from faults. */
class TimeRoundingTest {
    private val plain = TimeForm(TimeForm.Kind.PLAIN)

    private fun every(step: Double, rows: Int = 600, unit: Double = 1.0, from: Double = 0.3) =
        List(rows) { floor((from + step * it) / unit) * unit }

    private fun unit(times: List<Double>, form: TimeForm = plain) = TimeRounding.of(times, form)?.unit

    @Test
    fun timesThatWereCutAreKnownByTheirUnit() {
        for (step in listOf(0.07, 0.2, 0.5, 0.9, 0.95, 1.05, 1.3, 1.5, 2.5, 10.3)) {
            assertEquals(1.0, unit(every(step)), "every $step s")
            assertEquals(1.0, unit(every(step, from = 1.7e9)), "every $step s since 1970")
        }
        assertEquals(60.0, unit(every(10.0, unit = 60.0)))
        assertEquals(0.1, unit(every(0.04, unit = 0.1)))
        // 24 scans a second, in days of six decimals.
        val days = List(500) { floor((200.5 + it / 24.0 / 86_400) * 1e6) / 1e6 * 86_400 }
        assertEquals(0.0864, assertNotNull(unit(days, TimeForm(TimeForm.Kind.NUMBER, 86_400.0))), 1e-9)
    }

    @Test
    fun timesAsGoodAsTheyAreWrittenStay() {
        for (step in listOf(1.0, 2.0, 5.0, 60.0, 0.1, 0.25)) {
            assertNull(unit(List(600) { step * it }), "every $step s")
        }
        val random = Random(SEED)
        assertNull(unit(List(600) { 0.7 * it + random.nextDouble(0.2) }), "uneven")
        assertNull(unit(emptyList()))
        assertNull(unit(listOf(3.0)))
        assertNull(unit(listOf(Double.NaN, Double.NaN)))
    }

    @Test
    fun faultsAreNoRounding() {
        val exact = List(600) { it.toDouble() }
        assertNull(unit((exact + listOf(100.0, 200.0)).sorted()), "two times that come twice")
        assertNull(unit(List(600) { 10.0 * (it / 2) }), "two rows every ten seconds")
        assertNull(unit(List(600) { 20.0 * (it / 20) }), "twenty rows at once")
    }

    @Test
    fun rowsThatWereLostAreNoRounding() {
        val random = Random(SEED)
        val taken = (0 until LOGS).count {
            val part = random.nextDouble(0.01, 0.4)
            unit(List(1000) { i -> i.toDouble() }.filter { random.nextDouble() >= part }) != null
        }
        assertTrue(taken <= LOGS / 500, "$taken of $LOGS, seed $SEED")
    }

    private companion object {
        const val SEED = 20_261_127L
        const val LOGS = 2000
    }
}
