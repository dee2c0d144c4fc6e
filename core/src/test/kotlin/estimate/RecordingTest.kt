package stillwater.estimate

import org.junit.jupiter.api.Test
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse

class RecordingTest {
    /** Counts what it is given. */
    private class Counter : ReadingPlayer {
        override val filters = 3
        var taken = 0

        override fun enter(slot: Int, from: Double, until: Double) = Unit

        override fun take(slot: Int, seconds: Double, value: Double) {
            taken++
        }

        override fun leave() = Unit
    }

    private val parts = Parts()

    /** Ten readings a stay in one of so many [cells], through a lag of [timeConstant] s. */
    private fun tape(random: Random, stays: Int, cells: Int, timeConstant: Double): ReadingTape {
        val tape = ReadingTape(10 * stays)
        val truths = DoubleArray(cells) { random.nextDouble() - 0.5 }
        var state = 0.0
        for (i in 0 until 10 * stays) {
            val slot = i / 10 * 7 % cells
            state += (1 - exp(-1 / timeConstant)) * (truths[slot] - state)
            tape.add(slot, i.toDouble(), state + 0.002 * (random.nextDouble() - 0.5))
        }
        return tape
    }

    private fun partsOf(task: suspend () -> Unit): Int {
        var count = 0
        parts.begin(task)
        while (parts.isBusy) {
            parts.go(100.0)
            count++
        }
        return count
    }

    @Test
    fun whatIsLeftEarlyTakesAsManyPartsAsWhatIsPlayedToItsEnd() {
        val tape = tape(Random(1), stays = 50, cells = 9, timeConstant = 8.0)
        val recording = Recording(tape, parts, heedsBorders = false)
        recording.begin(500)
        val whole = Counter()
        val left = Counter()
        val expected = partsOf { recording.play(whole) }
        assertEquals(expected, partsOf { recording.play(left) { left.taken >= 100 } })
        assertEquals(500, whole.taken)
        assertFalse(left.taken >= 200, "went on to reading ${left.taken}")
    }

    /** The oracle plays all to their ends. */
    @Test
    fun theSearchForALagFindsWhatAFullSearchFinds() {
        val belief = SelfCalibratingSettings()
        val noise = SensorFit.FIRST_NOISE * SensorFit.FIRST_NOISE
        for (seed in 1..20) {
            val random = Random(seed)
            val tape = tape(random, stays = 5 + 3 * seed, cells = 12, timeConstant = exp(random.nextDouble(0.0, 4.5)))
            val recording = Recording(tape, parts, heedsBorders = false)
            recording.begin(tape.size)
            var best = Double.NaN
            var least = Double.POSITIVE_INFINITY
            val bank = LagBank()
            val reach = ceil(1.5 * belief.spread / 0.45).toInt()
            for (k in -reach..reach) {
                bank.reset(belief.mean + 3 * k * 0.15, 0.15, noise)
                partsOf { recording.play(bank) }
                for (i in 0..2) {
                    val off = bank.node + (i - 1) * bank.step - belief.mean
                    val cost = bank.misfit(i) / noise + off * off / (belief.spread * belief.spread)
                    if (cost < least) {
                        least = cost
                        best = off + belief.mean
                    }
                }
            }
            var found = Double.NaN
            partsOf { found = LagFit(belief).search(recording) }
            assertEquals(0.0, abs(found - best), 1e-9, "seed $seed: ln τ $found, by a full search $best")
        }
    }
}
