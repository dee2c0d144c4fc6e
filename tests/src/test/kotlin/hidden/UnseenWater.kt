package stillwater.hidden

import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * What of an effect shows to one who knows how short the water's waves are but not the water, and where the boat was
 * but for the jitter of its fixes.
 *
 * The water is a sum of plane waves of all directions, as short as the field's shortest and longer, of whose heights
 * nothing is known. Jitter of a fix moves the water that is believed to be at the probe; seen through the lag that is
 * noise with the lag's own correlation, of the variance (gradient · jitter)² period / (2 τ). Smoothing the fixes does
 * not help: it leaves what is slower than the lag as it is.
 *
 * @param world the world. @param noise the sensor's. @param timeConstant τ, s. @param length the waves' middle length,
 * m. @param jitter of fixes, m. @param flat columns of which nothing is known: what the sensor's numbers change.
 */
internal class UnseenWater(
    private val world: HiddenWorld,
    private val noise: HiddenNoise,
    private val timeConstant: Double,
    private val length: Double,
    jitter: Double,
    flat: List<DoubleArray>,
) {
    private val rows = world.rows
    private val period = world.track.step * world.per
    private val gradient = 2 * PI / length * world.amplitude / sqrt(2.0)
    private val swayed = gradient * jitter * sqrt(period / (2 * timeConstant))
    private val columns = (waves() + flat).map { whitened(it) }
    private val factor: Array<DoubleArray>

    init {
        val count = columns.size
        // Heights of which nothing is known: what a lag does to them could as well be the water's.
        val variance = UNKNOWN * world.amplitude * world.amplitude / maxOf(count - flat.size, 1)
        factor = Array(count) { a ->
            DoubleArray(a + 1) { b ->
                var sum = if (a == b) if (a < count - flat.size) 1 / variance else 1e-12 else 0.0
                for (i in 0 until rows) sum += columns[a][i] * columns[b][i]
                sum
            }
        }
        for (a in 0 until count) {
            for (b in 0..a) {
                var value = factor[a][b]
                for (k in 0 until b) value -= factor[a][k] * factor[b][k]
                factor[a][b] = if (a == b) sqrt(maxOf(value, 1e-12)) else value / factor[b][b]
            }
        }
    }

    /** √λ of the best test for the [difference] of readings. */
    fun distance(difference: DoubleArray): Double {
        val z = whitened(difference)
        val half = DoubleArray(columns.size) { a -> z.indices.sumOf { columns[a][it] * z[it] } }
        for (a in half.indices) {
            for (k in 0 until a) half[a] -= factor[a][k] * half[k]
            half[a] /= factor[a][a]
        }
        return sqrt(maxOf(z.sumOf { it * it } - half.sumOf { it * it }, 0.0))
    }

    /**
     * Waves on a lattice, as the lag shows them, half as long as [length] and longer: that there are no shorter ones
     * shows in the readings, but that a long wave is not the water's, which a quantity that goes with place may have,
     * nobody can know.
     */
    private fun waves(): List<DoubleArray> {
        val at = IntArray(rows) { (it + 1) * world.per }
        val x = DoubleArray(rows) { world.track.x[at[it]] }
        val y = DoubleArray(rows) { world.track.y[at[it]] }
        val east = x.max() - x.min() + length / 2
        val north = y.max() - y.min() + length / 2
        val found = ArrayList<DoubleArray>()
        val most = 2 / length
        for (j in 0..(most * east).toInt()) {
            for (k in -(most * north).toInt()..(most * north).toInt()) {
                val number = hypot(j / east, k / north)
                val isHalf = j > 0 || k >= 0
                if (!isHalf || number > most || number == 0.0) continue
                val phase = DoubleArray(rows) { 2 * PI * (j / east * x[it] + k / north * y[it]) }
                found += lagged(DoubleArray(rows) { cos(phase[it]) })
                found += lagged(DoubleArray(rows) { sin(phase[it]) })
            }
        }
        return found
    }

    private fun lagged(column: DoubleArray): DoubleArray {
        var s = column[0]
        return DoubleArray(rows) { i ->
            val middle = if (i == 0) column[0] else (column[i] + column[i - 1]) / 2
            s += -expm1(-period / timeConstant) * (middle - s)
            s
        }
    }

    /** [column] as innovations: a filter of the sensor's correlated noise and of what jitter makes, both at once. */
    private fun whitened(column: DoubleArray): DoubleArray {
        val keep = doubleArrayOf(exp(-period / noise.time), exp(-period / timeConstant))
        val still = doubleArrayOf(noise.share * noise.spread * noise.spread, swayed * swayed)
        val white = (1 - noise.share + 1e-9) * noise.spread * noise.spread
        val mean = DoubleArray(2)
        var p = still[0]
        var q = still[1]
        var both = 0.0
        return DoubleArray(column.size) { i ->
            val total = p + q + 2 * both + white
            val surprise = column[i] - mean[0] - mean[1]
            val a = (p + both) / total
            val b = (q + both) / total
            mean[0] = keep[0] * (mean[0] + a * surprise)
            mean[1] = keep[1] * (mean[1] + b * surprise)
            val pp = p - a * a * total
            val qq = q - b * b * total
            both = keep[0] * keep[1] * (both - a * b * total)
            p = keep[0] * keep[0] * pp + still[0] * (1 - keep[0] * keep[0])
            q = keep[1] * keep[1] * qq + still[1] * (1 - keep[1] * keep[1])
            surprise / sqrt(total)
        }
    }

    private companion object {
        const val UNKNOWN = 1e4
    }
}
