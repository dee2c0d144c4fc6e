package stillwater.estimate

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * A survey of legs up and down over random smooth water, read by a sensor that runs ten times as fine as it is logged,
 * with noise, a last digit and a receiver that repeats its fix more often than not.
 */
internal class LawnmowerLog(seed: Int, stages: List<SensorStage>, legs: Int = 12, noise: Double = 0.01) {
    val series: TrackSeries
    val truth: DoubleArray

    init {
        val random = Random(seed)
        val waves = List(WAVES) {
            val scale = 1 / (LENGTH_M * sqrt(random.nextDouble() + FLOOR))
            doubleArrayOf(scale * random.normal(), scale * random.normal(), 2 * PI * random.nextDouble())
        }

        fun water(x: Double, y: Double) = LEVEL + waves.sumOf { cos(it[0] * x + it[1] * y + it[2]) } * sqrt(2.0 / WAVES)

        val sensor = SensorSpec("test", stages).build(water(0.0, 0.0), random)
        val rows = ArrayList<DoubleArray>()
        var fixX = 0.0
        var fixY = 0.0
        var x = 0.0
        var y = 0.0

        fun sail(toX: Double, toY: Double) {
            var shown = 0.0
            for (part in 1..FINE) {
                val share = (part - 0.5) / FINE
                shown = sensor.step(water(x + share * (toX - x), y + share * (toY - y)), 1.0 / FINE, Conditions.NONE)
            }
            x = toX
            y = toY
            if (rows.isEmpty() || random.nextDouble() < FRESH) {
                fixX = FIX_M * Math.rint(x / FIX_M)
                fixY = FIX_M * Math.rint(y / FIX_M)
            }
            val value = DIGIT * Math.rint((shown + noise * random.normal()) / DIGIT)
            rows += doubleArrayOf(rows.size.toDouble(), fixX, fixY, value, water(x, y))
        }
        for (leg in 0 until legs) {
            val speed = if (leg % 2 == 0) NORTH_SPEED else -SOUTH_SPEED
            while ((y + speed) in 0.0..LEG_M) sail(x, y + speed)
            repeat(TURN_ROWS) { sail(x + SPACING_M / TURN_ROWS, y) }
        }

        fun column(k: Int) = DoubleArray(rows.size) { rows[it][k] }
        series = TrackSeries(column(0), column(1), column(2), column(3))
        truth = column(4)
    }

    private fun Random.normal() = sqrt(-2 * ln(1 - nextDouble())) * cos(2 * PI * nextDouble())

    private companion object {
        const val WAVES = 60
        const val LENGTH_M = 25.0
        const val FLOOR = 0.1
        const val LEVEL = 100.0
        const val FINE = 10
        const val FRESH = 0.45
        const val FIX_M = 0.42
        const val DIGIT = 0.01
        const val NORTH_SPEED = 0.8
        const val SOUTH_SPEED = 0.92
        const val LEG_M = 180.0
        const val TURN_ROWS = 14
        const val SPACING_M = 12.0
    }
}
