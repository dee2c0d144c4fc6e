package stillwater.estimate

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Learns how noisy a sensor's readings are, while it is moving, from third differences of evenly spaced readings.
 *
 * A response that is smooth over four readings nearly vanishes in z₄ − 3 z₃ + 3 z₂ − z₁; white noise of variance σ² is
 * left there with 20 σ². A square counts for [CAP] times the mean at the most, so that an outlier weighs little. Noise
 * is kept for rising and for falling readings apart. [resolution] is the smallest step seen: a sensor that rounds
 * coarsely and moves slowly shows no noise, and is still wrong by half of that.
 *
 * O(1), no allocation.
 *
 * @param smallest steps up to this are rounding of the numbers, not of the sensor; sensor units.
 */
internal class ReadingNoise(private val smallest: Double) {
    private val times = DoubleArray(KEPT)
    private val values = DoubleArray(KEPT)
    private var count = 0
    private val means = DoubleArray(2)
    private val counts = IntArray(2)

    // Asked for many times a reading, and changed by few.
    private val deviations = DoubleArray(2)
    private var areCurrent = false

    /** Smallest difference between successive readings that is none of rounding, sensor units; 0 before any. */
    var resolution: Double = 0.0
        private set

    /** Forgets the readings, not what was learned: for a gap, or another cell. */
    fun interrupt() {
        count = 0
    }

    /** Takes the reading [value], sensor units, of [seconds], s, while readings rise or, where not [rising], fall. */
    fun add(seconds: Double, value: Double, rising: Boolean) {
        if (count == KEPT) {
            for (i in 1 until KEPT) {
                times[i - 1] = times[i]
                values[i - 1] = values[i]
            }
            count--
        }
        times[count] = seconds
        values[count++] = value
        if (count >= 2) {
            val step = abs(value - values[count - 2])
            if (step > smallest && step.isFinite() && (resolution == 0.0 || step < resolution)) {
                resolution = step
                areCurrent = false
            }
        }
        if (count == KEPT && evenlySpaced()) learn(rising)
    }

    /** Standard deviation σ of readings that rise, or fall; half a step's uniform error at the least, sensor units. */
    fun deviation(rising: Boolean): Double {
        if (!areCurrent) {
            for (side in 0..1) {
                // One direction that was hardly seen borrows from the other.
                val learned = if (counts[side] >= FEWEST) means[side] else pooled()
                deviations[side] = sqrt(maxOf(learned / THIRD_DIFFERENCE, resolution * resolution / UNIFORM))
            }
            areCurrent = true
        }
        return deviations[if (rising) 0 else 1]
    }

    /** What is left of [deviation] without the uniform error of rounding to [resolution], sensor units. */
    fun besidesRounding(deviation: Double): Double =
        sqrt(maxOf(0.0, deviation * deviation - resolution * resolution / UNIFORM))

    private fun pooled(): Double {
        val all = counts[0] + counts[1]
        return if (all == 0) 0.0 else (means[0] * counts[0] + means[1] * counts[1]) / all
    }

    private fun learn(rising: Boolean) {
        val third = values[3] - values[0] + 3 * (values[1] - values[2])
        val square = third * third
        if (!square.isFinite()) return
        val side = if (rising) 0 else 1
        val all = pooled()
        val counted = if (counts[0] + counts[1] < FEWEST) square else minOf(square, CAP * all)
        if (counts[side] < MOST) counts[side]++
        means[side] += (counted - means[side]) / counts[side]
        areCurrent = false
    }

    private fun evenlySpaced(): Boolean {
        val mean = (times[3] - times[0]) / 3
        for (i in 1 until KEPT) if (!(abs(times[i] - times[i - 1] - mean) <= UNEVEN * mean)) return false
        return mean > 0
    }

    private companion object {
        const val KEPT = 4
        const val THIRD_DIFFERENCE = 20.0
        const val UNIFORM = 12.0
        const val CAP = 9.0
        const val FEWEST = 16

        /** Beyond so many, a new square weighs as one in so many: noise may change over a day. */
        const val MOST = 10_000

        /** Steps may differ by this share. */
        const val UNEVEN = 0.1
    }
}
