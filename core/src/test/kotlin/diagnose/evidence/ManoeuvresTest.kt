package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertFalse

/** What is to be done next separates what is open. */
class ManoeuvresTest {
    @Test
    fun comingBackDoesNotTellTheSensorsZeroFromTheWater() {
        for (cause in listOf(Cause.DRIFT, Cause.OFFSET_STEPS, Cause.CROSS_SENSITIVITY)) {
            val open = Manoeuvres.of(setOf(cause, Cause.TIME_VARYING_FIELD))
            assertContains(open, "a sample that stays as it is")
            assertFalse("come back" in open, open)
        }
        assertContains(Manoeuvres.of(setOf(Cause.DRIFT, Cause.OFFSET_STEPS)), "come back to the same place")
    }
}
