package stillwater.diagnosis

import org.junit.jupiter.api.Test
import stillwater.plot.Series
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Where means of residuals stand, and what is joined. */
class ResidualMeansTest {
    private val time = DoubleArray(400) { it.toDouble() }
    private val residual = DoubleArray(400) { if (it / 100 % 2 == 0) 0.5 else -0.25 }
    private val means = ResidualMeans(residual, time, CorrelatedNoise(0.1, 0.0, 0.0))

    private fun Series.points() = x.indices.filter { y[it].isFinite() }.map { x[it] to y[it] }

    private fun List<Series>.mean() = single { it.name == ResidualMeans.MEAN }

    private fun List<Series>.band() = single { it.name == ResidualMeans.BAND }

    @Test
    fun headingsOfASurveyHaveOneMeanEachAndNothingInBetween() {
        val sectors = means.inSectors(DoubleArray(400) { if (it / 100 % 2 == 0) 90.0 else 270.0 })
        // Rounding of sines.
        val points = sectors.mean().points()
        assertEquals(2, points.size)
        assertEquals(90.0, points[0].first, 1e-9)
        assertEquals(270.0, points[1].first, 1e-9)
        assertEquals(listOf(0.5, -0.25), points.map { it.second })
        val mean = sectors.mean()
        assertTrue(mean.y[1].isNaN() && mean.x.size == 3, "a line across headings that no row has")
        // Two standard errors of 200 rows, in a band that is drawn though no other is beside it.
        val band = sectors.band()
        assertTrue(band.y.all { it.isNaN() }, "a line of its own")
        assertEquals(0.5 - 0.2 / Math.sqrt(200.0), checkNotNull(band.lower)[0], 1e-12)
        assertTrue(band.x[1] > band.x[0] && band.lower[2].isNaN(), band.x.toList().toString())
    }

    @Test
    fun sectorsBesideEachOtherAreJoinedThoughNorthToEastIsBetween() {
        // About 0 degrees, three either way, and about 18.
        val sectors = means.inSectors(DoubleArray(400) { listOf(357.0, 3.0, 0.0, 20.0)[it % 4] })
        val points = sectors.mean().points().sortedBy { it.first }
        assertEquals(2, points.size, "$points")
        assertTrue(points.any { it.first < 1e-9 || it.first > 360 - 1e-9 }, "$points")
        assertEquals(20.0, points.single { it.first in 10.0..30.0 }.first, 1e-9)
        val full = means.inSectors(DoubleArray(400) { it * 0.9 })
        assertEquals(20, full.mean().points().size)
        // All round: nothing is interrupted.
        assertTrue(full.mean().y.none { it.isNaN() })
        assertTrue(full.mean().x.toList().zipWithNext().all { (a, b) -> a < b })
    }

    @Test
    fun partsHaveAsManyRowsEachAndNeverDivideRowsWithTheSameNumber() {
        assertEquals(20, means.inParts(time).mean().points().size)
        val speeds = means.inParts(DoubleArray(400) { if (it < 390) 1.0 else 1.0 + it / 1000.0 })
        assertEquals(listOf(1.0), speeds.mean().points().map { it.first }.filter { it < 1.2 })
        val none = means.inParts(DoubleArray(400) { Double.NaN })
        assertEquals(0, none.mean().points().size)
    }
}
