package stillwater.diagnose.blind

import kotlin.test.Test
import kotlin.test.assertEquals

/** How sure a trial is by its likelihood and by fits without each stretch of the log. */
class BlindTrialTest {
    private fun look(chance: Double) = BlindTrial(null, "the speed", null, null, DoubleArray(8), 60.0, 1.0, 2, chance)

    @Test
    fun theLessSureOfLikelihoodAndStretchesCounts() {
        assertEquals(0.03, look(1e-6).leftOut(0.03).pValue)
        assertEquals(1e-6, look(1e-6).leftOut(1e-9).pValue)
        assertEquals(1e-4, look(1e-6).leftOut(1e-9).sure(adjusted = 1e-4))
    }

    @Test
    fun stretchesAgreeAtFiveTimesTheLevelWhereChanceIsNextToNothing() {
        assertEquals(0.006, look(1e-14).leftOut(0.03).pValue, 1e-15)
        assertEquals(0.2, look(1e-14).leftOut(1.0).pValue, 1e-15)
        assertEquals(0.02, look(1e-14).leftOut(0.03).sure(adjusted = 0.02))
    }
}
