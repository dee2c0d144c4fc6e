package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** Two loggers of which one has a clock that is fast: no cause of the list, and no dead time. Seeds fixed before the first run. */
class ClockDriftTest {
    private val n = 900
    private val end = 2.0 * n

    /** Samples that are changed at any moment, each 40 to 140 s long. */
    private fun bench(random: Random): (Double) -> Double {
        val moves = generateSequence(0.0) { it + 40 + 100 * random.nextDouble() }.takeWhile { it < 2 * end }.toList()
        val levels = moves.map { 3 + 8 * random.nextDouble() }
        return { time -> levels[moves.indexOfLast { it <= time }.coerceAtLeast(0)] }
    }

    private fun waves(time: Double) = 8 + 2 * sin(time / 40) + sin(time / 17 + 1) + 0.6 * sin(time / 90 + 2)

    /** A lag of 8 s and a [deadTime], rows of 2 s, beside a reference whose clock gains [rate] seconds a second about the middle. */
    private fun log(random: Random, deadTime: Double, rate: Double, water: (Double) -> Double): MeasuredSeries {
        val per = 40
        var state = water(-deadTime)
        val times = DoubleArray(n) { 2.0 * it }
        val values = DoubleArray(n) { row ->
            repeat(per) { k ->
                val time = times[row] - 2 + 2 * (k + 0.5) / per
                state += (1 - exp(-2.0 / per / 8)) * (water(time - deadTime) - state)
            }
            state + 0.02 * random.nextGaussian()
        }
        val reference = DoubleArray(n) { water(times[it] + rate * (times[it] - end / 2)) }
        return MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, reference)
    }

    private fun verdict(log: MeasuredSeries) = Diagnosis(log).run().verdict

    @Test
    fun aClockThatIsFastIsToldOfSamplesAndOfWater() {
        for (seed in 20261211L..20261212L) {
            val random = Random(seed)
            for (log in listOf(log(random, 3.0, 0.004, bench(random)), log(random, 0.0, 0.003, ::waves))) {
                val what = assertIs<Verdict.Unexplained>(verdict(log), "seed $seed").what
                assertContains(what, "one of two clocks is fast", message = "seed $seed")
            }
        }
    }

    @Test
    fun howLateTheReadingsAreIsToldOfBothEnds() {
        val what = assertIs<Verdict.Unexplained>(verdict(log(Random(20261213), 0.0, 0.003, ::waves))).what
        val numbers = Regex("""are ([\d.]+) s ahead of .* and ([\d.]+) s later than it""").find(what)
        val (ahead, later) = checkNotNull(numbers) { what }.destructured
        assertEquals(2.7, ahead.toDouble(), 0.3, what)
        assertEquals(2.7, later.toDouble(), 0.3, what)
    }

    @Test
    fun aDelayThatStaysIsADeadTime() {
        val random = Random(20261214)
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), verdict(log(random, 5.0, 0.0, bench(random))))
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), verdict(log(random, 5.0, 0.0, ::waves)))
    }
}
