package stillwater.run

import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.MethodSource
import stillwater.model.Grid
import stillwater.plan.LawnmowerPattern
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class ExperimentSettingsTest {
    class Case(val message: String, val change: ExperimentSettings.() -> ExperimentSettings) {
        override fun toString() = message
    }

    @ParameterizedTest
    @MethodSource("cases")
    fun isRefusedByNameWithTheValueAndTheRule(case: Case) {
        val base = Preset.REPORT.settings()
        val refused = assertFailsWith<IllegalArgumentException> { case.change(base) }
        assertEquals(case.message, refused.message)
    }

    @Test
    fun gridsWithoutAHamiltonianCycleAreFineWithoutALawnmowerOrWithAnotherPattern() {
        val odd = Grid.unit(3, 3)
        val base = Preset.REPORT.settings()
        assertEquals(odd, base.copy(grid = odd, planners = listOf(PlannerKind.RANDOM_WALK)).grid)
        val raster = PlannerSettings(pattern = LawnmowerPattern.RASTER)
        assertEquals(odd, base.copy(grid = odd, plannerSettings = raster).grid)
    }

    private companion object {
        @JvmStatic
        fun cases() = listOf(
            Case("fields must not be empty") { copy(fields = emptyMap()) },
            Case("filters must not be empty") { copy(filters = emptyList()) },
            Case("planners must not be empty") { copy(planners = emptyList()) },
            Case("environments (0) must be at least 1") { copy(environments = 0) },
            Case("moves (0) must be at least 1") { copy(moves = 0) },
            Case("samplesPerMove (0) must be at least 1") { copy(samplesPerMove = 0) },
            Case("period (0.0 s) must be above 0 and finite") { copy(period = 0.0) },
            Case("period (NaN s) must be above 0 and finite") { copy(period = Double.NaN) },
            Case("period (Infinity s) must be above 0 and finite") { copy(period = Double.POSITIVE_INFINITY) },
            Case("checkpoints must not be empty") { copy(checkpoints = emptyList()) },
            Case("checkpoints ([5, 5]) must ascend") { copy(checkpoints = listOf(5, 5)) },
            Case("checkpoints ([7, 5]) must ascend") { copy(checkpoints = listOf(7, 5)) },
            Case("checkpoints ([0, 5]) must lie within 1..2000") { copy(checkpoints = listOf(0, 5)) },
            Case("checkpoints ([5, 2001]) must lie within 1..2000") { copy(checkpoints = listOf(5, 2001)) },
            Case(
                "the Hamiltonian cycle needs an even number of rows or columns and two of each at least, not 3 x 3; " +
                    "choose another lawnmower pattern",
            ) { copy(grid = Grid.unit(3, 3)) },
        )
    }
}
