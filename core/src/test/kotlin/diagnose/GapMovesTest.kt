package stillwater.diagnose

import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertIs

/** A bench where the sample is written down only once the probe is in it. */
class GapMovesTest {
    /** A lag of [lag] s moved to another sample each minute, a row a second, without the first [missing] rows of each. */
    private fun bench(missing: Int, noise: Double = 0.0, lag: Double = LAG): MeasuredSeries {
        val random = java.util.Random(SEED)
        val samples = doubleArrayOf(2.0, 8.0, 5.0, 11.0, 3.0, 9.0)
        var state = samples[0]
        val truth = DoubleArray(ROWS) { samples[it / MINUTE % samples.size] }
        val readings = DoubleArray(ROWS) {
            if (it > 0) state += (1 - exp(-1 / lag)) * (truth[it] - state)
            state + 0.02 * random.nextGaussian()
        }
        val rows = (0 until ROWS).filter { it % MINUTE >= missing }
        fun kept(column: DoubleArray) = DoubleArray(rows.size) { column[rows[it]] }
        val still = DoubleArray(rows.size)
        val reference = kept(truth).also { all -> for (i in all.indices) all[i] += noise * random.nextGaussian() }
        return MeasuredSeries(DoubleArray(rows.size) { rows[it].toDouble() }, still, still, kept(readings), reference)
    }

    @Test
    fun movesThatAreNotWrittenLeaveTheLagAloneToSettlingAfterThem() {
        for ((missing, noise) in listOf(4 to 0.0, 10 to 0.0, 6 to 0.01)) {
            val result = Diagnosis(bench(missing, noise)).run()
            val why = assertIs<Verdict.InsufficientData>(result.verdict, "$missing rows, seed $SEED").why
            assertContains(why, "(14 gaps)")
            val found = result.baseline.parameters.associate { it.name to it.value }
            assertEquals(LAG, found.getValue("time_constant_s"), 0.2, "$missing rows, seed $SEED")
            assertEquals(1.0, found.getValue("gain"), 0.005, "$missing rows, seed $SEED")
            assertEquals(0.02, result.baseline.noiseSpread, 0.004, "$missing rows, seed $SEED")
        }
    }

    @Test
    fun aProbeThatHasSettledBeforeRowsAreWrittenShowsNoLag() {
        val result = Diagnosis(bench(missing = 20, lag = 2.0)).run()
        assertIs<Verdict.InsufficientData>(result.verdict, "seed $SEED")
        assertEquals(emptyList(), result.baseline.parameters, "seed $SEED")
    }

    @Test
    fun aGivenLagThatSettlingSpeaksAgainstIsTold() {
        val log = bench(missing = 10)
        val found = Diagnosis(log).run().baseline.parameters.first().value
        fun why(given: Double) =
            Diagnosis(log, DiagnosisSettings(base = SensorSpec("given", listOf(SensorStage.Lag(given))))).run()
                .let { assertIs<Verdict.InsufficientData>(it.verdict, "seed $SEED").why }
        assertContains(why(3.0), "and not the 3.00 s of the sensor given")
        assertFalse("sensor given" in why(found), "seed $SEED")
    }

    @Test
    fun movesThatAreDo() {
        val result = Diagnosis(bench(missing = 0)).run()
        assertIs<Verdict.Consistent>(result.verdict, "seed $SEED")
        val found = result.baseline.parameters.first { it.name == "time_constant_s" }.value
        assertEquals(LAG, found, 0.1, "seed $SEED")
    }

    private companion object {
        const val SEED = 20261127L
        const val MINUTE = 60
        const val ROWS = 900
        const val LAG = 8.0
    }
}
