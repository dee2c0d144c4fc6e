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

/** An instrument that gives means of its last readings is none of the causes, and neither are these such means. Seeds fixed before the first run. */
class RunningMeanTest {
    private val n = 1500

    private fun water(time: Double) = 8 + sin(time / 11) + 0.6 * sin(time / 5.3 + 1) + 0.4 * sin(time / 29)

    private fun log(values: DoubleArray): MeasuredSeries {
        val still = DoubleArray(n)
        val times = DoubleArray(n) { it.toDouble() }
        return MeasuredSeries(times, still, still, values, DoubleArray(n) { water(times[it]) })
    }

    /** What a lag of [lag] s shows so many seconds [later], a hundred times a second; each second the mean of [over] s. */
    private fun shown(lag: Double, later: Double, over: Double): DoubleArray {
        val per = 100
        var state = water(-later)
        val fine = DoubleArray(n * per) { i ->
            state += (1 - exp(-1.0 / per / lag)) * (water((i + 0.5) / per - later) - state)
            state
        }
        val sums = fine.runningFold(0.0, Double::plus)
        return DoubleArray(n) { row ->
            val to = row * per + 1
            val from = maxOf(to - maxOf((over * per).toInt(), 1), 0)
            (sums[to] - sums[from]) / (to - from)
        }
    }

    private fun noisy(column: DoubleArray, spread: Double, seed: Long): DoubleArray {
        val random = Random(seed)
        return DoubleArray(n) { column[it] + spread * random.nextGaussian() }
    }

    private fun unexplained(values: DoubleArray) = assertIs<Verdict.Unexplained>(
        Diagnosis(log(values)).run().verdict,
    ).what

    @Test
    fun theyAreToldWithTheirLength() {
        val what = unexplained(noisy(shown(4.0, 0.0, 12.0), 0.02, 2101))
        assertContains(
            what,
            Regex("running means over 1(1\\.[5-9]|2\\.[0-5])\\d* s of what a lag of (3\\.[89]|4\\.[0-2])\\d* s"),
        )
    }

    @Test
    fun noiseThatIsAveragedTellsOfThemToo() {
        val random = Random(2102)
        val noise = DoubleArray(n) { 0.3 * random.nextGaussian() }
        val water = shown(4.0, 0.0, 9.0)
        val means = DoubleArray(n) { i -> water[i] + (maxOf(i - 8, 0)..i).sumOf { noise[it] } / 9 }
        assertContains(unexplained(means), "averages")
    }

    @Test
    fun aDeadTimeAndASecondLagStayWhatTheyAre() {
        val late = Diagnosis(log(noisy(shown(4.0, 5.0, 0.0), 0.02, 2103))).run().verdict
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), late)
        val once = shown(6.0, 0.0, 0.0)
        val twice = once.copyOf()
        for (i in 1 until n) {
            twice[i] =
                twice[i - 1] + (1 - exp(-1 / 3.0)) * ((once[i] + once[i - 1]) / 2 - twice[i - 1])
        }
        val second = Diagnosis(log(noisy(twice, 0.02, 2104))).run().verdict
        assertEquals(Verdict.Named(listOf(Cause.SECOND_ORDER_RESPONSE)), second)
    }
}
