package stillwater.diagnose.reference

import stillwater.diagnose.MeasuredSeries
import stillwater.model.Conditions
import kotlin.math.PI
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class ArmSwingTest {
    private val rows = 400
    private val times = DoubleArray(rows) { it.toDouble() }

    private fun swing(x: DoubleArray, y: DoubleArray, truth: DoubleArray, speed: Double): ArmSwing {
        val speeds = mapOf(Conditions.SPEED to DoubleArray(rows) { speed })
        val series = MeasuredSeries(times, x, y, truth, truth, speeds)
        return ArmSwing(series, truth)
    }

    @Test
    fun onAStraightWayNothingIsInDoubt() {
        val x = DoubleArray(rows) { 0.8 * it }
        val truth = DoubleArray(rows) { sin(x[it] / 5) }
        val doubts = swing(x, DoubleArray(rows), truth, speed = 0.8).doubts(1.5)
        // What was there before the first row is in doubt on any way.
        assertTrue(doubts.drop(2).all { it < 1e-6 }, "${doubts.toList()}")
    }

    /** On a circle of R m the end of an arm of d m is √(R² + d²) from the middle, and the way ends d/R behind. */
    @Test
    fun onACircleAsMuchAsTheWaterIsSteepFarOffTheWay() {
        val radius = 10.0
        val turned = DoubleArray(rows) { 0.08 * it }
        val truth = DoubleArray(rows) { 0.3 * radius * turned[it] }
        val swing = swing(
            DoubleArray(rows) { radius * cos(turned[it]) },
            DoubleArray(rows) { radius * sin(turned[it]) },
            truth,
            speed = 0.8,
        )
        for (behind in listOf(2.0, -2.0)) {
            val away = hypot(radius, behind)
            val angle = atan2(2.0, radius) - 2.0 / radius
            val off = hypot(away * cos(angle) - radius, away * sin(angle))
            val doubts = swing.doubts(behind)
            // Twice, because it lasts from row to row.
            for (i in 50 until rows - 50) assertEquals(2 * 0.3 * off, doubts[i], 0.2 * 0.3 * off, "row $i, $behind m")
        }
    }

    @Test
    fun inACornerForAsLongAsTheArmNeedsToComeRound() {
        val corner = 200
        val x = DoubleArray(rows) { minOf(it, corner) * 0.5 }
        val y = DoubleArray(rows) { maxOf(it - corner, 0) * 0.5 }
        val truth = DoubleArray(rows) { sin(x[it] / 5) + cos(2 * PI * y[it] / 25) }
        val doubts = swing(x, y, truth, speed = 0.5).doubts(2.0)
        val swung = (4 until rows).filter { doubts[it] > 0.05 }
        assertTrue(swung.all { it in corner - 5..corner + 9 }, "$swung")
        assertTrue((corner..corner + 2).all { doubts[it] > 0.4 })
    }
}
