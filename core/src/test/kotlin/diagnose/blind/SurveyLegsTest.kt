package stillwater.diagnose.blind

import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.Verdict
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNull
import kotlin.test.assertTrue

class SurveyLegsTest {
    private fun assertLag(expected: Double, result: DiagnosisResult, seed: Long) {
        assertEquals(Verdict.Consistent, result.verdict, "seed $seed")
        val lag = result.baseline.parameters.first { it.name == "time_constant_s" }
        assertTrue(expected in checkNotNull(lag.interval), "$lag, seed $seed")
    }

    /** Rows twice as often do not make the water finer, nor the legs farther apart. */
    @Test
    fun legsNeedBeNoNearerThanTheWaterIsFine() {
        for (period in listOf(1.0, 0.5)) {
            val seed = 20261129L
            val series = SurveyLegs(rows = 1200, period, apart = 4.0, length = 40.0).log(seed, wave = 25.0) { LAG }
            assertLag(LAG, Diagnosis(series).run(), seed)
        }
    }

    @Test
    fun legsThatAreFartherApartThanTheWavesShowNothing() {
        val seed = 20261130L
        val series = SurveyLegs(rows = 1000, period = 1.0, apart = 9.0, length = 40.0).log(seed, wave = 6.0) { LAG }
        val why = assertIs<Verdict.InsufficientData>(Diagnosis(series).run().verdict, "seed $seed").why
        assertContains(why, "no pass comes within")
    }

    /** Water that is let change in time makes up for it, unless each half is asked by itself. */
    @Test
    fun aLagThatDoublesHalfWayIsUnexplained() {
        val seed = 20261201L
        val rows = 1300
        // There and back over the same two legs.
        val legs = SurveyLegs(rows, period = 1.0, apart = 1.0, length = 80.0)
        val series = legs.log(seed, wave = 30.0) { if (it < rows / 2) LAG else 2 * LAG }
        val what = Diagnosis(series).run().verdict.let { assertIs<Verdict.Unexplained>(it, "$it, seed $seed") }.what
        assertContains(what, "in the first half")
        val (first, second) = listOf(series.part(0, rows / 2), series.part(rows / 2, rows)).map { half ->
            Diagnosis(half).run().baseline.parameters.first { it.name == "time_constant_s" }.value
        }
        assertEquals(LAG, first, 0.1 * LAG, "seed $seed")
        assertEquals(2 * LAG, second, 0.1 * 2 * LAG, "seed $seed")
    }

    @Test
    fun halvesWithOneLagSayNothing() {
        val seed = 20261202L
        val series = SurveyLegs(rows = 1000, period = 1.0, apart = 1.0, length = 80.0).log(seed, wave = 30.0) { LAG }
        assertNull(LagOfHalves(series, DiagnosisSettings(), Loops.IN_TURN).words(), "seed $seed")
    }

    private companion object {
        const val LAG = 10.0
    }
}
