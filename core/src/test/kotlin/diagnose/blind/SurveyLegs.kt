package stillwater.diagnose.blind

import stillwater.diagnose.MeasuredSeries
import java.util.Random
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin

/** A survey of parallel legs, [apart] m apart and [length] m long, at half a metre a second, with a row every [period] s. */
internal class SurveyLegs(
    private val rows: Int,
    private val period: Double,
    private val apart: Double,
    private val length: Double,
) {
    /** Metres east and north after [time] s. */
    private fun place(time: Double): Pair<Double, Double> {
        val round = 2 * (length + apart)
        val way = SPEED * time
        val legs = (way / round).toInt()
        val rest = way - legs * round
        val north = 2 * legs * apart
        return when {
            rest < length -> rest to north
            rest < length + apart -> length to north + rest - length
            rest < 2 * length + apart -> 2 * length + apart - rest to north + apart
            else -> 0.0 to north + apart + rest - 2 * length - apart
        }
    }

    /** What a sensor shows whose lag after so many seconds is [lag], in water of waves of [wave] m, noise of 0.003 added. */
    fun log(seed: Long, wave: Double, lag: (Double) -> Double): MeasuredSeries {
        val random = Random(seed)
        val waves = List(WAVES) {
            val turn = 2 * PI * random.nextDouble()
            val k = 2 * PI / (wave * (1 + random.nextDouble()))
            Triple(k * cos(turn), k * sin(turn), 2 * PI * random.nextDouble())
        }
        fun water(time: Double): Double {
            val (x, y) = place(time)
            return waves.sumOf { (a, b, phase) -> cos(a * x + b * y + phase) } / 2
        }
        var state = water(0.0)
        val values = DoubleArray(rows) { row ->
            for (step in 0 until if (row > 0) STEPS else 0) {
                val time = (row - 1 + (step + 0.5) / STEPS) * period
                state += (1 - exp(-period / STEPS / lag(time))) * (water(time) - state)
            }
            state + NOISE * random.nextGaussian()
        }
        val times = DoubleArray(rows) { it * period }
        val x = DoubleArray(rows) { place(times[it]).first }
        val y = DoubleArray(rows) { place(times[it]).second }
        return MeasuredSeries(times, x, y, values, null)
    }

    private companion object {
        const val SPEED = 0.5
        const val NOISE = 0.003
        const val STEPS = 20
        const val WAVES = 8
    }
}
