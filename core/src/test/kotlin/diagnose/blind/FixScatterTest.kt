package stillwater.diagnose.blind

import org.junit.jupiter.api.Test
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

class FixScatterTest {
    private val n = 900
    private val track = CrossingTrack(n)
    private val shown = track.shown(LAG)

    /** The log with fixes that are off by what [errors] makes of [java.util.Random], m, on either axis. */
    private fun log(noise: Double, errors: (java.util.Random) -> DoubleArray): MeasuredSeries {
        val random = java.util.Random(SEED)
        val values = DoubleArray(n) { shown[it] + noise * random.nextGaussian() }
        fun off(column: DoubleArray) = errors(random).let { error -> DoubleArray(n) { column[it] + error[it] } }
        return MeasuredSeries(track.times, off(track.x), off(track.y), values, null)
    }

    private fun scattered(by: Double) = log(0.004) { random -> DoubleArray(n) { by * random.nextGaussian() } }

    private fun wandering(by: Double, time: Double) = log(0.03) { random ->
        val keep = exp(-1 / time)
        var now = by * random.nextGaussian()
        DoubleArray(n) {
            now = keep * now + by * sqrt(1 - keep * keep) * random.nextGaussian()
            now
        }
    }

    private fun told(result: DiagnosisResult) =
        result.warnings.firstOrNull { "fixes are off" in it || "fixes scatter" in it }

    @Test
    fun fixesThatAreRightAreNotSpokenOf() = assertEquals(null, told(Diagnosis(scattered(0.0)).run()))

    /** The parabolas through the fixes about each one leave about a third of errors that are new with each. */
    @Test
    fun fixesThatScatterByMoreThanTheReadingsDoAreTold() {
        val told = assertNotNull(told(Diagnosis(scattered(0.8)).run()))
        val by = Regex("(off by some|scatter by) ([0-9.]+) m").find(told)?.groupValues?.get(2)?.toDouble()
        assertTrue(assertNotNull(by, told) in 0.15..0.9, told)
    }

    /** An error that wanders is in the readings as the water is steep, and no response of another shape. */
    @Test
    fun fixesThatWanderAreToldAndNothingElseIsFound() {
        val result = Diagnosis(wandering(0.35, 10.0)).run()
        assertTrue(result.verdict is Verdict.Consistent, "${result.verdict}, seed $SEED")
        val told = assertNotNull(told(result))
        val by = Regex("off by some ([0-9.]+) m for ([0-9.]+) s").find(told)?.groupValues
        val (deviation, time) = assertNotNull(by, told).drop(1).map { it.toDouble() }
        assertEquals(0.35, deviation, 0.15, told)
        assertTrue(time in 4.0..25.0, told)
        val lag = result.baseline.parameters.first { it.name == "time_constant_s" }
        val interval = assertNotNull(lag.interval)
        assertTrue(LAG in interval.lower..interval.upper, "$interval, seed $SEED")
    }

    private companion object {
        const val LAG = 5.0
        const val SEED = 3L
    }
}
