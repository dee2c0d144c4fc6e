package stillwater.plot

import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class ErrorCurvesTest {
    private val moves = DoubleArray(2000) { it + 1.0 }

    private fun curve(planner: String, filter: String, decay: Double): ErrorCurve {
        val error = DoubleArray(moves.size) { 0.25 * exp(-it / decay) + 0.01 }
        return ErrorCurve(
            planner,
            filter,
            moves,
            error,
            DoubleArray(moves.size) { error[it] * 0.9 },
            DoubleArray(moves.size) { error[it] * 1.1 },
        )
    }

    private val six = listOf("random-walk", "lawnmower", "bounded").flatMapIndexed { index, planner ->
        listOf(curve(planner, "bounded", 300.0 + index), curve(planner, "averaging", 900.0 + index))
    }

    @Test
    fun sixCurvesHaveOneLineEachInThePlannersColourAndTheFiltersLineType() {
        val parts = SvgParts(ErrorCurves("Uniform field", "100 environments", six).draw())
        for (colour in listOf(SvgParts.BLUE, SvgParts.VERMILION, SvgParts.GREEN)) {
            val lines = parts.strokes(colour)
            assertEquals(2, lines.size, "lines in $colour")
            assertEquals(1, lines.count { it.getAttribute("stroke-dasharray").isEmpty() }, "solid lines in $colour")
        }
    }

    @Test
    fun titleSubtitleAxesAndLegendAreWritten() {
        val texts = SvgParts(ErrorCurves("Uniform field", "100 environments", six).draw()).texts
        val wanted = listOf("Uniform field", "100 environments", "Moves", "Mean absolute error", "Planner", "Filter")
        for (text in wanted + listOf("random-walk", "lawnmower", "averaging")) assertContains(texts, text)
        assertEquals(2, texts.count { it == "bounded" }, "bounded is a planner and a filter")
    }

    @Test
    fun eachCurveWithABandHasOneShade() {
        val shades = SvgParts(ErrorCurves("t", "", six).draw()).fills(SvgParts.BLUE)
        assertEquals(2, shades.size)
        val bare = ErrorCurves("t", "", listOf(ErrorCurve("a", "bounded", moves, moves))).draw()
        assertEquals(0, SvgParts(bare).fills(SvgParts.BLUE).size)
    }

    @Test
    fun aFilterKeepsItsLineTypeWhateverTheOrder() {
        val swapped = ErrorCurves(
            "t",
            "",
            listOf(curve("walk", "averaging", 300.0), curve("lawn", "bounded", 300.0)),
        ).draw()
        val parts = SvgParts(swapped)
        assertTrue(parts.strokes(SvgParts.BLUE).single().getAttribute("stroke-dasharray").isNotEmpty())
        assertTrue(parts.strokes(SvgParts.VERMILION).single().getAttribute("stroke-dasharray").isEmpty())
    }

    @Test
    fun thousandsOfMovesAreThinnedToWhatCanBeSeen() {
        val line = SvgParts(
            ErrorCurves("t", "", listOf(curve("walk", "bounded", 300.0))).draw(),
        ).strokes(SvgParts.BLUE).single()
        val points = line.getAttribute("d").count { it == 'L' || it == 'M' }
        assertTrue(points in 100..1000, "points drawn: $points")
    }

    @Test
    fun aSpikeNarrowerThanAPixelIsNotThinnedAway() {
        val x = DoubleArray(100_000) { it.toDouble() }
        val y = DoubleArray(x.size) { if (it == 54_321) 9.0 else 1.0 }
        val line = SvgParts(
            LinePlot("t", "", listOf(Series("a", x, y)), "x", "y").draw(),
        ).strokes(SvgParts.BLUE).single()
        val heights = Regex("[ML][\\d.]+ ([\\d.]+)").findAll(line.getAttribute("d")).map {
            it.groupValues[1].toDouble()
        }
        assertEquals(2, heights.toSet().size, "the level and the spike")
    }

    @Test
    fun aGapInTheCurveBreaksTheLine() {
        val error = DoubleArray(moves.size) { if (it in 200..300) Double.NaN else 0.1 }
        val parts = SvgParts(ErrorCurves("t", "", listOf(ErrorCurve("walk", "bounded", moves, error))).draw())
        assertEquals(2, parts.strokes(SvgParts.BLUE).size)
    }

    @Test
    fun noCurvesAndNothingButNanSayThatThereIsNoData() {
        val nothing = ErrorCurve("walk", "bounded", moves, DoubleArray(moves.size) { Double.NaN })
        assertContains(SvgParts(ErrorCurves("t", "", emptyList()).draw()).texts, "no data")
        assertContains(SvgParts(ErrorCurves("t", "", listOf(nothing)).draw()).texts, "no data")
    }

    @Test
    fun zerosOnALogarithmicAxisAreLeftOutAndAllZerosMakeItLinear() {
        val some = ErrorCurve("walk", "bounded", doubleArrayOf(1.0, 10.0, 100.0), doubleArrayOf(0.5, 0.05, 0.0))
        assertEquals(1, SvgParts(ErrorCurves("t", "", listOf(some)).draw()).strokes(SvgParts.BLUE).size)
        val none = ErrorCurve("walk", "bounded", doubleArrayOf(1.0, 10.0), doubleArrayOf(0.0, 0.0))
        assertContains(SvgParts(ErrorCurves("t", "", listOf(none)).draw()).texts, "0.0")
    }

    @Test
    fun onePointAndHugeValuesCanBeDrawn() {
        for (value in listOf(1e-299, 1e-9, 1.0, 1e9, 1e299)) {
            val figure = ErrorCurves(
                "t",
                "",
                listOf(ErrorCurve("w", "bounded", doubleArrayOf(1.0), doubleArrayOf(value))),
            ).draw()
            assertContains(SvgParts(figure).texts, "Moves")
        }
        val wide = Series("a", doubleArrayOf(1.0, 2.0), doubleArrayOf(-1e300, 1e300))
        val figure = LinePlot("t", "", listOf(wide), "x", "y").draw()
        assertEquals(1, SvgParts(figure).strokes(SvgParts.BLUE).size)
    }

    @Test
    fun lengthsThatDifferAreRefusedByName() {
        val message = assertFailsWith<IllegalArgumentException> {
            ErrorCurve("w", "f", doubleArrayOf(1.0, 2.0), doubleArrayOf(1.0))
        }.message
        assertEquals("error has 1 values but move has 2; give one each", message)
        assertFailsWith<IllegalArgumentException> { ErrorCurve("w", "f", moves, moves, lower = moves) }
    }
}
