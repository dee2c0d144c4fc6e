package stillwater.drive

import stillwater.estimate.SensorBelief
import stillwater.mission.EstimatorName
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNull

class MapCautionsTest {
    private fun caution(estimator: EstimatorName, isExplained: Boolean, areCellsEven: Boolean) =
        MapCautions.unexplained(estimator, SensorBelief(isExplained, areCellsEven, emptyList()), ", as in a storm")

    @Test
    fun whyNoSensorIsLearnedIsWhatTheReadingsShow() {
        val uneven = caution(EstimatorName.SELF_CALIBRATING, isExplained = false, areCellsEven = false).orEmpty()
        assertContains(uneven, "nothing shows that the water changes at their borders and not within them")
        assertContains(uneven, "the readings' spread")
        val even = caution(EstimatorName.SELF_CALIBRATING, isExplained = false, areCellsEven = true).orEmpty()
        assertContains(even, "no sensor model explains the readings, as in a storm")
        assertFalse("spread" in even, even)
        assertNull(caution(EstimatorName.SELF_CALIBRATING, isExplained = true, areCellsEven = true))
    }

    @Test
    fun aBayesianMapThatDoesNotHoldHasNoBounds() {
        for (areCellsEven in listOf(true, false)) {
            val words = caution(EstimatorName.BAYESIAN, isExplained = false, areCellsEven = areCellsEven).orEmpty()
            assertEquals("the map has no bounds", words.substringAfterLast(": "))
        }
    }
}
