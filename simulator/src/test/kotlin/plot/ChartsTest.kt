package stillwater.plot

import kotlin.math.pow
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class ChartsTest {
    private val time = DoubleArray(100) { it.toDouble() }

    @Test
    fun eachSeriesHasALineInItsOwnColourAndALegendEntry() {
        val plot =
            LinePlot(
                "Probe",
                "",
                listOf(Series("truth", time, time), Series("probe", time, time, time, time)),
                "s",
                "mg/L",
            )
        val parts = SvgParts(plot.draw())
        assertEquals(1, parts.strokes(SvgParts.BLUE).size)
        assertEquals(1, parts.strokes(SvgParts.VERMILION).size)
        assertEquals(1, parts.fills(SvgParts.VERMILION).size, "the band")
        for (text in listOf("Probe", "truth", "probe", "s", "mg/L")) assertContains(parts.texts, text)
    }

    @Test
    fun aBandWithoutALineIsDrawnInPartsWhereItHasAGap() {
        val none = DoubleArray(100) { Double.NaN }
        val low = DoubleArray(100) { if (it == 50) Double.NaN else 1.0 }
        val band = Series("bounds", time, none, low, DoubleArray(100) { 7.0 })
        val parts = SvgParts(LinePlot("Probe", "", listOf(band, Series("truth", time, time)), "s", "mg/L").draw())
        assertEquals(0, parts.strokes(SvgParts.BLUE).size, "no line")
        val keys = parts.all("line").map { it.getAttribute("stroke") }
        assertTrue(
            "rgb(179,213,232)" in keys && SvgParts.BLUE !in keys,
            "the legend's key has the band's colour: $keys",
        )
        val bands = parts.fills(SvgParts.BLUE)
        assertEquals(2, bands.size, "either side of the gap")
    }

    /** A point of many that fall on one half pixel of the figure. */
    @Test
    fun aBandWithoutALineKeepsAGapOfOnePointAmongMany() {
        val size = 100_000
        val many = DoubleArray(size) { it.toDouble() }
        val none = DoubleArray(size) { Double.NaN }
        val low = DoubleArray(size) {
            if (it == 0 || it == 50_001) {
                Double.NaN
            } else if (it == 2) {
                -3.0
            } else {
                1.0
            }
        }
        val band = Series("bounds", many, none, low, DoubleArray(size) { 7.0 })
        val truth = Series("truth", many, DoubleArray(size) { if (it % 2 == 0) -5.0 else 9.0 })
        val parts = SvgParts(LinePlot("Probe", "", listOf(band, truth), "s", "mg/L").draw())
        val bands = parts.fills(SvgParts.BLUE)
        assertEquals(2, bands.size, "either side of the gap")
        // The lowest of the first half pixel is there although its first point has none.
        val heights = bands.flatMap { Regex("[ML][\\d.]+[ ,]([\\d.]+)").findAll(it.getAttribute("d")) }
            .map { it.groupValues[1].toDouble() }.distinct()
        assertEquals(3, heights.size, "$heights")
    }

    @Test
    fun pointsAreAllDrawnAndASeriesWithoutNameHasNoLegend() {
        val y = DoubleArray(100) { if (it % 10 == 0) Double.NaN else it - 50.0 }
        val plot =
            LinePlot(
                "Residuals",
                "",
                listOf(Series("", time, y, mark = Mark.POINTS)),
                "s",
                "mg/L",
                references = listOf(0.0),
            )
        val parts = SvgParts(plot.draw())
        assertEquals(90, parts.all("circle").size)
        assertEquals(1, parts.all("line").count { it.getAttribute("stroke-width") == "1.76" }, "the line at 0")
    }

    @Test
    fun aLineJoinsItsPointsInTheirOrder() {
        val loop = Series("a", doubleArrayOf(0.0, 2.0, 1.0, 3.0), doubleArrayOf(0.0, 1.0, 2.0, 3.0))
        val line = SvgParts(LinePlot("t", "", listOf(loop), "x", "y").draw()).strokes(SvgParts.BLUE).single()
        val across = Regex("[ML]([\\d.]+)").findAll(line.getAttribute("d")).map {
            it.groupValues[1].toDouble()
        }.distinct().toList()
        assertEquals(listOf(0, 2, 1, 3), across.map { across.sorted().indexOf(it) })
    }

    @Test
    fun aBandReachingBelowALogarithmicAxisIsCutNotLost() {
        val low = DoubleArray(100) { -1.0 }
        val plot = LinePlot("t", "", listOf(Series("a", time, time, low, time)), "s", "u", yScale = AxisScale.LOG10)
        assertEquals(1, SvgParts(plot.draw()).fills(SvgParts.BLUE).size)
    }

    @Test
    fun aStatisticIsAMarkOnItsNullDistributionAndAnArrowWhereItIsFarOut() {
        val chance = DoubleArray(200) { (it - 99.5) / 57.7 }
        fun statistic(name: String, value: Double) = NullDistribution(name, value, chance)
        val near = SvgParts(NullDistributions("t", "", listOf(statistic("a", 1.0), statistic("b", -2.0))).draw())
        assertEquals(2, near.fills(SvgParts.BLUE).size, "a density each")
        val marks = near.all("line").filter { it.getAttribute("stroke") == SvgParts.VERMILION }
        assertEquals(2, marks.size)
        // Standard deviations apart, on an axis of 13.
        val across = marks.map { it.getAttribute("x1").toDouble() }
        val ticks = near.all("line").filter { it.getAttribute("stroke") != SvgParts.VERMILION }
            .filter { it.getAttribute("x1") == it.getAttribute("x2") && it.getAttribute("x1") != "0.0" }
            .map { it.getAttribute("x1").toDouble() }.distinct().sorted()
        assertEquals(3.0, (across[0] - across[1]) / ((ticks.last() - ticks.first()) / 12), 0.01)
        val far = SvgParts(NullDistributions("t", "", listOf(statistic("a", 25.0), statistic("b", -9.0))).draw())
        assertEquals(0, far.all("line").count { it.getAttribute("stroke") == SvgParts.VERMILION })
        for (text in listOf("25 →", "← −9")) assertContains(far.texts, text)
        assertFailsWith<IllegalArgumentException> { NullDistribution("a", 1.0, doubleArrayOf(1.0)) }
    }

    @Test
    fun emptyChartsSayThatThereIsNoData() {
        val none = NullDistributions("t", "", listOf(NullDistribution("a", Double.NaN, doubleArrayOf(1.0, 2.0))))
        assertContains(SvgParts(none.draw()).texts, "no data")
        assertContains(SvgParts(LinePlot("t", "", emptyList(), "x", "y").draw()).texts, "no data")
        assertContains(SvgParts(Bars("t", "", listOf(Bar("a", Double.NaN)), "u").draw()).texts, "no data")
        assertContains(SvgParts(Histogram.of("t", "", doubleArrayOf(Double.NaN), 5, "u").draw()).texts, "no data")
    }

    @Test
    fun aHistogramCountsEveryFiniteValueOnce() {
        val values = doubleArrayOf(0.0, 0.1, 0.5, 0.9, 1.0, Double.NaN, Double.POSITIVE_INFINITY)
        val parts = SvgParts(Histogram.of("t", "", values, 2, "u").draw())
        val bars = parts.all("rect").filter { it.getAttribute("fill") == SvgParts.BLUE }
        val heights = bars.map { it.getAttribute("height").toDouble() }
        assertEquals(2, bars.size)
        // 0.0 and 0.1 below, 0.5, 0.9 and 1.0 above; heights are rounded to 0.01 px.
        assertEquals(1.5, heights[1] / heights[0], 1e-3)
    }

    @Test
    fun constantAndSingleValuesMakeOneBar() {
        for (value in listOf(0.0, 5.0, -1e12, 1e300)) {
            val bars = SvgParts(Histogram.of("t", "", doubleArrayOf(value, value), 9, "u").draw()).all("rect")
            assertEquals(1, bars.count { it.getAttribute("fill") == SvgParts.BLUE }, "$value")
        }
    }

    @Test
    fun histogramsThatMakeNoSenseAreRefused() {
        assertFailsWith<IllegalArgumentException> {
            Histogram("t", "", doubleArrayOf(0.0, 1.0), longArrayOf(1, 2), "u")
        }
        assertFailsWith<IllegalArgumentException> { Histogram("t", "", doubleArrayOf(1.0, 0.0), longArrayOf(1), "u") }
        assertFailsWith<IllegalArgumentException> { Histogram("t", "", doubleArrayOf(0.0, 1.0), longArrayOf(-1), "u") }
    }

    @Test
    fun barsShowTheirWholeNames() {
        val name = "legs heading north-east, against the light wind"
        val texts = SvgParts(Bars("t", "", listOf(Bar(name, 1.0, 0.5, 1.5), Bar("turns", -2.0)), "u").draw()).texts
        assertContains(texts, name)
        assertFalse(texts.any { it.endsWith("..") })
    }

    @Test
    fun ticksAreRoundAndWithinTheAxis() {
        assertEquals(listOf("0", "5", "10"), Ticks.linear(-1.0, 11.0, 4).labels)
        assertEquals(listOf("−0.2", "0.0", "0.2"), Ticks.linear(-0.25, 0.3, 4).labels)
        assertEquals(listOf("1", "10", "100", "1000"), Ticks.log(1.0, 2000.0, 6).labels)
        assertEquals(listOf("0.05", "0.1", "0.2"), Ticks.log(0.04, 0.25, 8).labels)
        assertEquals(listOf("0", "1e299", "2e299", "3e299"), Ticks.linear(0.0, 3e299, 4).labels)
    }

    @Test
    fun anAxisThatEndsBeyondAllNumbersHasAFewTicks() {
        for ((from, to) in listOf(1e-3 to Double.POSITIVE_INFINITY, 0.0 to 1e300, 0.0 to Double.POSITIVE_INFINITY)) {
            val places = Ticks.log(from, to, 8).places
            assertTrue(places.size in 2..8 && places.all { it.isFinite() && it > 0 }, "$from to $to: $places")
        }
    }

    @Test
    fun numbersFromTheSmallestToTheLargestHaveALogarithmicAxis() {
        val wide = DoubleArray(100) { 10.0.pow(6.0 * it - 297) }
        val plot = LinePlot("t", "", listOf(Series("s", time, wide)), "s", "u", yScale = AxisScale.LOG10)
        val axis = SvgParts(plot.draw())
        assertEquals(1, axis.strokes(SvgParts.BLUE).size)
        assertFalse(axis.texts.any { "Infinity" in it || "NaN" in it }, "${axis.texts}")
    }
}
