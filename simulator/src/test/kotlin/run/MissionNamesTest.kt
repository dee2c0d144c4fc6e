package stillwater.run

import org.junit.jupiter.api.Test
import stillwater.mission.EstimatorName
import stillwater.mission.PlannerName
import kotlin.test.assertEquals

/** What a mission's file calls an estimator or a planner is what the command line calls it, and nothing is missing. */
class MissionNamesTest {
    @Test
    fun aMissionNamesEveryFilterOfTheCommandLine() {
        val names = EstimatorName.serializer().descriptor.let { d -> List(d.elementsCount, d::getElementName) }
        assertEquals(FilterKind.entries.map { it.label }.sorted(), names.sorted())
    }

    @Test
    fun aMissionNamesEveryPlannerOfTheCommandLine() {
        val names = PlannerName.serializer().descriptor.let { d -> List(d.elementsCount, d::getElementName) }
        assertEquals(PlannerKind.entries.map { it.label }.sorted(), names.sorted())
    }
}
