package stillwater.benchmark

import stillwater.benchmark.HandMadeResult.Companion.AVERAGING
import stillwater.benchmark.HandMadeResult.Companion.BOUNDED
import stillwater.benchmark.HandMadeResult.Companion.LAWNMOWER
import stillwater.benchmark.HandMadeResult.Companion.WALK
import stillwater.plot.ErrorCurves
import stillwater.run.ExperimentResult
import stillwater.run.Preset
import stillwater.world.UniformField
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertNull

class BenchmarkTableTest {
    private val result = HandMadeResult()
        .curve(WALK, BOUNDED, 0.25, 0.125, 0.0123456)
        .curve(LAWNMOWER, AVERAGING, 0.5, 0.375, 0.1)
        .curve(WALK, BOUNDED, 0.75, 0.5, 0.25, field = Preset.GAUSSIAN)
        .build()

    @Test
    fun aFieldHasARowForEachOfItsCombinationsAndAColumnForEachNamedMove() {
        val table = BenchmarkTable.of(result, Preset.UNIFORM)
        assertEquals(listOf("planner", "filter", "50", "100", "200"), table.columns.map { it.header })
        assertEquals(
            listOf(
                listOf("random-walk", "bounded", "0.250", "0.125", "0.0123"),
                listOf("lawnmower", "averaging", "0.500", "0.375", "0.100"),
            ),
            table.rows,
        )
        assertEquals(1, BenchmarkTable.of(result, Preset.GAUSSIAN).rows.size)
    }

    @Test
    fun boundsHaveARowForEachFilterThatGivesThemAndTheWidthAtTheEnd() {
        val table = assertNotNull(BenchmarkTable.bounds(result, Preset.UNIFORM))
        assertEquals(listOf("planner", "filter", "50", "100", "200", "width"), table.columns.map { it.header })
        assertEquals(listOf(listOf("random-walk", "bounded", "0.875", "0.875", "0.875", "0.250")), table.rows)
        assertNull(BenchmarkTable.bounds(HandMadeResult().curve(WALK, AVERAGING, 0.5, 0.25, 0.1).build(), "uniform"))
    }

    @Test
    fun theLastMoveIsShownThoughItHasNoName() {
        val odd = ExperimentResult(
            result.settings.copy(moves = 210, checkpoints = listOf(50, 100, 200, 210)),
            emptyList(),
            emptyMap(),
        )
        assertEquals(
            listOf("planner", "filter", "50", "100", "200", "210"),
            BenchmarkTable.of(odd, Preset.UNIFORM).columns.map { it.header },
        )
    }

    @Test
    fun figuresBearTheReportsNumbersWhereItHasThem() {
        val figures = BenchmarkFigures.of(result)
        assertEquals(listOf("uniform" to "figure-6", "gaussian" to "figure-7"), figures.map { it.field to it.name })
        val lake = ExperimentResult(
            result.settings.copy(fields = mapOf("lake" to UniformField)),
            emptyList(),
            mapOf("lake" to 0.0),
        )
        assertEquals(listOf("errors-lake"), BenchmarkFigures.of(lake).map { it.name })
    }

    @Test
    fun aFigureNamesItsFieldItsSensorAndHowManyEnvironmentsItRestsOn() {
        val figure = BenchmarkFigures.of(result).first()
        assertIs<ErrorCurves>(figure.drawing)
        val svg = figure.drawing.draw().svg
        assertContains(svg, "every cell drawn by itself")
        assertContains(svg, "2 environments")
        assertContains(svg, "first-order-lag")
    }
}
