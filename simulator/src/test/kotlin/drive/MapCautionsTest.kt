package stillwater.drive

import stillwater.estimate.SensorBelief
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertFalse
import kotlin.test.assertNull

class MapCautionsTest {
    private fun caution(isExplained: Boolean, areCellsEven: Boolean = true, isWaterSteady: Boolean = true) =
        MapCautions.unexplained(SensorBelief(isExplained, areCellsEven, isWaterSteady, emptyList()), ", as in a storm")

    @Test
    fun manyReadingsAtPlacesInDoubtAreTold() {
        assertContains(MapCautions.doubted(100, 1000).orEmpty(), "100 of 1000 readings were taken while")
        // Until fixes have agreed, at the beginning, some always are.
        assertNull(MapCautions.doubted(15, 1000))
        assertNull(MapCautions.doubted(0, 0))
    }

    @Test
    fun whyNoSensorIsLearnedIsWhatTheReadingsShow() {
        val uneven = caution(isExplained = false, areCellsEven = false).orEmpty()
        assertContains(uneven, "nothing shows that the water changes at their borders and not within them")
        assertContains(uneven, "the readings' spread")
        val even = caution(isExplained = false).orEmpty()
        assertContains(even, "no sensor model explains the readings, as in a storm")
        assertFalse("spread" in even, even)
        val changed = caution(isExplained = false, isWaterSteady = false).orEmpty()
        assertContains(changed, "because their water changed between one visit and another")
        assertContains(changed, "the readings' spread")
        assertNull(caution(isExplained = true))
    }
}
