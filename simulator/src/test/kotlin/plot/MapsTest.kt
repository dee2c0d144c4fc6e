package stillwater.plot

import kotlin.math.PI
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class MapsTest {
    private fun cells(n: Int, rotation: Double = 0.0, value: (Int) -> Double) = List(n) {
        MapCell.rectangle(10.0 * it, 0.0, 10.0, 10.0, rotation, value(it))
    }

    private fun shapes(figure: Figure) = SvgParts(figure).all("path")
        .filter { it.getAttribute("stroke-width") == "0.55" }

    @Test
    fun everyCellIsOneShapeAndThoseWithoutValueAreGrey() {
        val figure = CellMap("Oxygen", "lake", cells(9) { if (it < 2) Double.NaN else it.toDouble() }, "mg/L").draw()
        assertEquals(9, shapes(figure).size)
        assertEquals(2, SvgParts(figure).fills(SvgParts.GREY).size)
        assertContains(SvgParts(figure).texts, "lake; grey: no value (2 of 9 cells)")
        assertContains(SvgParts(figure).texts, "mg/L")
    }

    @Test
    fun lowAndHighEndsHaveTheColoursOfTheScalesEnds() {
        val fills = shapes(CellMap("t", "", cells(3) { it.toDouble() }, "u").draw()).map { it.getAttribute("fill") }
        assertEquals(listOf("rgb(68,1,84)", "rgb(253,231,37)"), listOf(fills.first(), fills.last()), "viridis")
    }

    @Test
    fun valuesBeyondAGivenScaleTakeTheColourOfItsEnd() {
        val fills = shapes(CellMap("t", "", cells(4) { it * 10.0 }, "u", colours = 10.0..20.0).draw())
            .map { it.getAttribute("fill") }
        assertEquals(fills[0], fills[1])
        assertEquals(fills[2], fills[3])
        assertTrue(fills[1] != fills[2])
    }

    @Test
    fun valuesThatAreAllBeyondOneEndOfAGivenScaleCanBeDrawn() {
        for (least in listOf(14.3, 20.0, 3.0)) {
            val cells = CellMap("t", "", cells(4) { least + it / 10.0 }, "u", colours = 10.0..13.5).draw()
            assertEquals(1, shapes(cells).map { it.getAttribute("fill") }.distinct().size, "from $least")
        }
    }

    @Test
    fun valuesBeyondAGivenScaleAreCountedInTheSubtitle() {
        val cells = CellMap("t", "lake", cells(4) { it * 10.0 }, "u", colours = 10.0..20.0).draw()
        assertContains(SvgParts(cells).texts, "lake; 2 of 4 cells lie beyond the colours' ends")
        val x = DoubleArray(5) { it.toDouble() }
        val track = TrackMap("t", "", x, x, x, "u", colours = 1.0..4.0).draw()
        assertContains(SvgParts(track).texts, "1 of 5 points lie beyond the colours' ends")
        val whole = TrackMap("t", "", x, x, x, "u").draw()
        assertTrue(SvgParts(whole).texts.none { "beyond" in it })
    }

    @Test
    fun differencesAreWhiteAtZeroAndAsDarkEitherWay() {
        val fills = shapes(CellMap("t", "", cells(3) { it - 1.0 }, "u", isDifference = true).draw())
            .map { it.getAttribute("fill") }
        assertEquals(listOf("rgb(33,102,172)", "rgb(247,247,247)", "rgb(178,24,43)"), fills)
        // Seen from its middle the scale does not move where all are above.
        val above = shapes(CellMap("t", "", cells(3) { it + 0.0 }, "u", isDifference = true).draw())
        assertEquals("rgb(247,247,247)", above.first().getAttribute("fill"))
        for (only in listOf(0.0, -1e-5, 3.0)) {
            assertEquals(1, shapes(CellMap("t", "", cells(1) { only }, "u", isDifference = true).draw()).size, "$only")
        }
    }

    @Test
    fun cellsKnownFromOneSideAreSmallOnGrey() {
        val cells = List(4) { MapCell.rectangle(10.0 * it, 0.0, 10.0, 10.0, 0.0, it + 0.0, isHalfKnown = it == 1) }
        val figure = CellMap("t", "lake", cells, "u").draw()
        assertContains(SvgParts(figure).texts, "lake; small: one bound only (1 of 4)")
        assertEquals(1, SvgParts(figure).fills(SvgParts.GREY).size)
        val wide = shapes(figure).map { shape ->
            Regex("(-?[\\d.]+) (-?[\\d.]+)").findAll(shape.getAttribute("d")).map { it.groupValues[1].toDouble() }
                .let { it.max() - it.min() }
        }
        assertEquals(listOf(0.5, 1.0), wide.map { Math.round(2 * it / wide.max()) / 2.0 }.distinct().sorted())
    }

    @Test
    fun aMetreIsAsLongOnEitherAxisAlsoForTurnedCells() {
        for (rotation in listOf(0.0, PI / 6)) {
            val d = shapes(CellMap("t", "", cells(7, rotation) { it.toDouble() }, "u").draw()).first().getAttribute("d")
            val points = Regex("(-?[\\d.]+) (-?[\\d.]+)").findAll(d).map {
                it.groupValues[1].toDouble() to
                    it.groupValues[2].toDouble()
            }
            val sides = points.toList().distinct().let { p -> p.indices.map { dist(p[it], p[(it + 1) % p.size]) } }
            assertEquals(4, sides.size)
            // Coordinates are rounded to 0.01 px.
            for (side in sides) assertEquals(sides[0], side, 0.03, "rotation $rotation")
        }
    }

    @Test
    fun constantOneCellHugeAndOnlyUnknownValuesCanBeDrawn() {
        assertEquals(
            1,
            shapes(
                CellMap(
                    "t",
                    "",
                    cells(5) {
                        7.25
                    },
                    "u",
                ).draw(),
            ).map { it.getAttribute("fill") }.toSet().size,
        )
        assertEquals(1, shapes(CellMap("t", "", cells(1) { 0.0 }, "u").draw()).size)
        assertEquals(3, shapes(CellMap("t", "", cells(3) { it * 1e300 }, "u").draw()).size)
        assertEquals(3, SvgParts(CellMap("t", "", cells(3) { Double.NaN }, "u").draw()).fills(SvgParts.GREY).size)
        assertEquals(2, shapes(CellMap("t", "", cells(2) { Double.POSITIVE_INFINITY * (it - 0.5) }, "u").draw()).size)
    }

    @Test
    fun mapsWithoutContentSaySo() {
        assertContains(SvgParts(CellMap("t", "", emptyList(), "u").draw()).texts, "no cells")
        val lost = doubleArrayOf(Double.NaN)
        assertContains(SvgParts(TrackMap("t", "", lost, lost, lost, "u").draw()).texts, "no positions")
    }

    @Test
    fun aTrackHasOnePointAReadingAndItsEndsMarked() {
        val x = DoubleArray(50) { it.toDouble() }
        val y = DoubleArray(50) { if (it == 20) Double.NaN else 0.5 * it }
        val parts = SvgParts(TrackMap("Track", "", x, y, x, "mg/L").draw())
        assertEquals(49, parts.all("circle").count { it.getAttribute("r").toDouble() < 3 })
        assertContains(parts.texts, "start")
        assertContains(parts.texts, "end")
        val silent = SvgParts(TrackMap("Track", "", x, x, DoubleArray(50) { Double.NaN }, "mg/L").draw())
        assertEquals(50, silent.all("circle").count { it.getAttribute("fill") == "#d9dcdf" })
        assertEquals(2, parts.strokes("rgb(138,144,150)").size, "the missing position breaks the track in two")
    }

    @Test
    fun badCellsAndTracksAreRefused() {
        assertFailsWith<IllegalArgumentException> { MapCell(doubleArrayOf(0.0, 1.0), doubleArrayOf(0.0, 1.0), 1.0) }
        assertFailsWith<IllegalArgumentException> { MapCell.rectangle(Double.NaN, 0.0, 1.0, 1.0, 0.0, 1.0) }
        assertFailsWith<IllegalArgumentException> {
            TrackMap("t", "", DoubleArray(2), DoubleArray(1), DoubleArray(2), "u")
        }
    }

    @Test
    fun longMapsKeepALegibleWidthAndFlatOnesTheirLegendBelow() {
        val tall = CellMap(
            "t",
            "",
            List(40) {
                MapCell.rectangle(0.0, 10.0 * it, 10.0, 10.0, 0.0, it + 0.0)
            },
            "u",
        ).draw()
        val flat = CellMap("t", "", cells(40) { it + 0.0 }, "u").draw()
        assertTrue(tall.width >= 600 && tall.height <= 900, "${tall.width} x ${tall.height} px")
        assertTrue(flat.width == 860 && flat.height in 250..400, "${flat.width} x ${flat.height} px")
    }

    private fun dist(a: Pair<Double, Double>, b: Pair<Double, Double>) =
        kotlin.math.hypot(a.first - b.first, a.second - b.second)
}
