package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Spline
import stillwater.model.Conditions
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class FinerTruthTest {
    private val rows = 120

    private fun water(time: Double) = sin(2 * PI * time / WAVE) + 0.5 * cos(2 * PI * time / (2.3 * WAVE))

    private fun log(times: DoubleArray) = MeasuredSeries(
        times,
        DoubleArray(times.size) { 2 * times[it] },
        DoubleArray(times.size),
        DoubleArray(times.size),
        DoubleArray(times.size) { water(times[it]) },
        mapOf(Conditions.TEMPERATURE to DoubleArray(times.size) { 10 + it * 0.1 }),
    )

    @Test
    fun wavesOfThreeRowsAreToldFarBetterThanByASpline() {
        val log = log(DoubleArray(rows) { it.toDouble() })
        val finer = FinerTruth(log, UnknownTruth.of(log), 1.4)
        val spline = Spline(log.times).also { it.fit(checkNotNull(log.reference)) }
        var worst = 0.0
        var bySpline = 0.0
        // Near the ends there are no rows on one side.
        for (i in 12 until rows - 12) {
            val time = i - 0.5
            assertEquals(time, finer.series.times[finer.rows[i] - 1])
            worst = maxOf(worst, abs(checkNotNull(finer.series.reference)[finer.rows[i] - 1] - water(time)))
            bySpline = maxOf(bySpline, abs(spline.at(i - 1, time) - water(time)))
        }
        assertTrue(worst < 0.01 && bySpline > 0.1, "off by $worst, a spline by $bySpline")
    }

    @Test
    fun rowsOfTheLogStayAsTheyAre() {
        val log = log(DoubleArray(rows) { it + 0.2 * sin(it.toDouble()) })
        val finer = FinerTruth(log, null, 1.0)
        assertEquals(2 * rows - 1, finer.series.size)
        fun back(column: DoubleArray) = DoubleArray(rows) { column[finer.rows[it]] }
        assertContentEquals(log.times, back(finer.series.times))
        assertContentEquals(log.reference, back(checkNotNull(finer.series.reference)))
        assertContentEquals(log.speed, back(finer.series.speed))
        assertContentEquals(log.temperature, back(checkNotNull(finer.series.temperature)))
    }

    @Test
    fun thereIsNoRowInAGap() {
        val log = log(DoubleArray(rows) { if (it < 60) it.toDouble() else it + 20.0 })
        val finer = FinerTruth(log, UnknownTruth.of(log), 1.0)
        assertEquals(2 * rows - 2, finer.series.size)
        assertEquals(1, finer.rows[60] - finer.rows[59])
        assertTrue(checkNotNull(finer.unknown).isGap[finer.rows[60]])
    }

    private companion object {
        /** Rows. */
        const val WAVE = 3.0
    }
}
