package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import kotlin.math.exp
import kotlin.math.roundToInt
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** A reference that is written in coarse steps, as by a meter with one decimal, beside a sensor with three. */
class CoarseTruthTest {
    private val n = 900

    private fun water(time: Double) = 15 + sin(time / 127 + 1) + 0.6 * sin(time / 48 + 2) + 0.3 * sin(time / 19)

    /** A lag of [timeConstant] s that shows the water [late] rows late, its reference written in [step]s. */
    private fun diagnosed(timeConstant: Double, step: Double, late: Int = 0): DiagnosisResult {
        val random = java.util.Random(6)
        val fine = 10
        var state = water(0.0)
        val values = DoubleArray(n) { row ->
            for (k in 0 until if (row == 0) 0 else fine) {
                val seen = row - late - 1 + (k + 0.5) / fine
                state += (1 - exp(-1 / (fine * timeConstant))) * (water(maxOf(seen, 0.0)) - state)
            }
            state + 0.004 * random.nextGaussian()
        }
        val reference = DoubleArray(n) { (water(it.toDouble()) / step).roundToInt() * step }
        val still = DoubleArray(n)
        return Diagnosis(MeasuredSeries(DoubleArray(n) { it.toDouble() }, still, still, values, reference)).run()
    }

    private fun DiagnosisResult.number(name: String) =
        (extended ?: baseline).parameters.single { it.name == name }.value

    @Test
    fun theLagIsThatOfASmoothTruthWithinTheSteps() {
        val result = diagnosed(12.0, 0.1)
        val why = (result.verdict as? Verdict.InsufficientData)?.why
        if (why == null) assertEquals(Verdict.Consistent, result.verdict) else assertContains(why, "in steps of 0.100")
        assertEquals(12.0, result.number("time_constant_s"), 0.4)
    }

    @Test
    fun aDeadTimeFarBeyondTheStepsIsNamed() {
        val result = diagnosed(12.0, 0.1, late = 9)
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict)
        assertEquals(9.0, result.number("dead_time_s"), 0.5)
        assertEquals(12.0, result.number("time_constant_s"), 0.5)
    }

    @Test
    fun whatRoundingMightDoIsNoCause() {
        val verdict = assertIs<Verdict.InsufficientData>(diagnosed(12.0, 0.5).verdict)
        assertContains(verdict.why, "the reference is written in steps of 0.500")
    }
}
