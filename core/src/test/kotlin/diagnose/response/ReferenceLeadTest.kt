package stillwater.diagnose.response

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** A reference with a short lag of its own is fast, and yet late: that must not become a cause of the sensor's. */
class ReferenceLeadTest {
    private val n = 900
    private val random = java.util.Random(5)

    /** What is to be said of it; the lag is looked for in steps of a twentieth. */
    private val late = Regex("ahead of the reference by 0\\.(19|20|21) s")

    private fun water(time: Double) = 5 + sin(time / 9) + 0.7 * sin(time / 23 + 1) + 0.3 * sin(time / 4.1 + 2)

    /** What [lags], s, one behind the other, show of the water each second, stepped a hundred times as often. */
    private fun shown(vararg lags: Double): DoubleArray {
        val states = DoubleArray(lags.size) { water(0.0) }
        return DoubleArray(n) { row ->
            if (row > 0) {
                for (k in 0 until 100) {
                    var seen = water(row - 1 + (k + 0.5) / 100)
                    for (i in lags.indices) {
                        states[i] += (1 - exp(-0.01 / lags[i])) * (seen - states[i])
                        seen = states[i]
                    }
                }
            }
            states.last()
        }
    }

    /** [values] with noise of a deviation of 0.005. */
    private fun noisy(values: DoubleArray) = DoubleArray(n) { values[it] + 0.005 * random.nextGaussian() }

    /** A sensor with a lag of [lag] s that drifts by [drift] units a second, beside a reference with one of 0.2 s. */
    private fun diagnosed(lag: Double, drift: Double): DiagnosisResult {
        val values = noisy(shown(lag))
        for (i in values.indices) values[i] += drift * i
        return diagnosed(values, shown(0.2))
    }

    private fun diagnosed(values: DoubleArray, reference: DoubleArray): DiagnosisResult {
        val times = DoubleArray(n) { it.toDouble() }
        for (i in reference.indices) reference[i] += 0.0005 * random.nextGaussian()
        return Diagnosis(MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, reference)).run()
    }

    @Test
    fun aReferenceThatIsLateByAFractionOfARowIsNoSecondPath() {
        val result = diagnosed(2.3, 0.0)
        assertEquals(Verdict.Consistent, result.verdict)
        assertTrue(result.warnings.any { late in it }, "${result.warnings}")
        assertEquals(2.3, result.baseline.parameters.first { it.name == "time_constant_s" }.value, 0.05)
    }

    @Test
    @Tag("long")
    fun aReferenceThatIsLateByRowsIsOrdinaryWhereTheSensorIsFarSlower() {
        val result = diagnosed(noisy(shown(40.0)), shown(1.5))
        assertEquals(Verdict.Consistent, result.verdict)
        val said = Regex("ahead of the reference by 1\\.[456] s")
        assertTrue(result.warnings.any { said in it }, "${result.warnings}")
        assertEquals(40.0, result.baseline.parameters.first { it.name == "time_constant_s" }.value, 1.0)
    }

    @Test
    @Tag("long")
    fun aReferenceThatIsLateByMoreThanARowMayBeStampedOffIsUnexplained() {
        val result = diagnosed(noisy(shown(8.0)), DoubleArray(n) { water(it - 0.8) })
        val reason = assertIs<Verdict.Unexplained>(result.verdict, "${result.verdict}").what
        assertContains(reason, "a lag of its own")
    }

    @Test
    @Tag("long")
    fun besideAnotherCauseAReferenceThatIsLateByAFractionOfARowIsNoShift() {
        val result = diagnosed(noisy(shown(6.0, 2.5)), shown(0.2))
        val sets = result.verdict.let { verdict ->
            if (verdict is Verdict.Named) verdict.causes.map { listOf(it) } else verdict.ambiguity
        }
        assertEquals(1, sets.size, "${result.verdict}")
        assertTrue(Cause.SECOND_ORDER_RESPONSE in sets.single(), "${result.verdict}")
        assertTrue(result.warnings.any { late in it }, "${result.warnings}")
    }

    @Test
    fun whatIsThereBesideAReferenceThatIsLateIsNamedAlone() {
        val result = diagnosed(2.3, 3e-5)
        assertEquals(Verdict.Named(listOf(Cause.DRIFT)), result.verdict)
        assertTrue(result.warnings.any { late in it }, "${result.warnings}")
    }

    @Test
    @Tag("long")
    fun wildReadingsBesideAClockThatIsBehindAreNamedThoughNoCauseTakesItsPlace() {
        repeat(3) { round ->
            val values = shown(0.1)
            for (i in values.indices) values[i] += 0.03 * random.nextGaussian()
            for (i in 40 until n step 75) values[i] += if (i % 2 == 0) 0.6 else -0.6
            val result = diagnosed(values, DoubleArray(n) { water(it - 0.4) })
            assertEquals(Verdict.Named(listOf(Cause.OUTLIERS)), result.verdict, "round $round")
            assertTrue(result.warnings.any { "ahead of the reference by" in it }, "${result.warnings}")
        }
    }
}
