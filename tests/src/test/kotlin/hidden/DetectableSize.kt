package stillwater.hidden

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * How strong an effect must be to be detectable in a log, from theory.
 *
 * The best test of one effect, for someone who knows the noise and the effect's shape but not the time constant, gain,
 * offset and first state, has the noncentrality λ = |P W (y(strength) − y(0))|², with W the whitening of the noise and
 * P the projection off what the unknowns can imitate. Strength 1x is where √λ = 6.36: at a level of 0.1 %, shared by 18
 * causes (two-sided 4.03 standard deviations), the test then has a power of 99 % (2.33 more).
 *
 * Where a sensor is given ([isGiven], with [offset]) its numbers are not unknown: only the first state is.
 * Without a reference nobody knows the water either, nor where the boat was better than its fixes say: [unseen] then
 * takes the place of P W.
 *
 * No effect is hidden whose size is below [least] at 1x: a shift of less than one step of the generator, of which there
 * are 20 to a row, is no effect. A log without any has one where another simulation stepped the sensor, or a clock
 * stamped the rows, and a perfect reference tells even a hundredth of a row.
 */
internal class DetectableSize(
    private val noise: HiddenNoise,
    private val readings: (Map<HiddenEffect, Double>) -> DoubleArray,
    private val base: (Double) -> DoubleArray,
    private val timeConstant: Double,
    private val isGiven: Boolean,
    private val offset: Double,
    private val least: Map<HiddenEffect, Double>,
    private val unseen: ((List<DoubleArray>) -> UnseenWater)? = null,
) {
    private val clean = base(timeConstant)
    private val unknowns = unknowns()
    private val imitable: List<DoubleArray> = imitable()
    private val water = unseen?.invoke(unknowns)

    /** What the sensor's unknown numbers change, near enough. */
    private fun unknowns(): List<DoubleArray> {
        val n = clean.size
        val longer = base(timeConstant * 1.01)
        val first = listOf(DoubleArray(n) { exp(-it / 10.0) })
        if (isGiven) return first
        return listOf(
            DoubleArray(n) { longer[it] - clean[it] },
            DoubleArray(n) { clean[it] - clean.average() },
            DoubleArray(n) { 1.0 },
        ) + first
    }

    private fun imitable(): List<DoubleArray> {
        val n = clean.size
        val found = ArrayList<DoubleArray>()
        for (column in unknowns) {
            val rest = off(noise.innovations(column), found)
            val length = sqrt(rest.sumOf { it * it })
            if (length > 0) found += DoubleArray(n) { rest[it] / length }
        }
        return found
    }

    private fun off(column: DoubleArray, directions: List<DoubleArray>): DoubleArray {
        val rest = column.copyOf()
        for (direction in directions) {
            val share = rest.indices.sumOf { rest[it] * direction[it] }
            for (i in rest.indices) rest[i] -= share * direction[i]
        }
        return rest
    }

    /** The strength of [effect] that is [multiple] times the detectable one; null where none is. */
    fun of(effect: HiddenEffect, multiple: Double): Double? {
        val largest = LARGEST[effect] ?: 3.0
        if (reach(effect, largest) < DETECTABLE * maxOf(multiple, 1.0)) return null
        var low = ln(largest * 1e-5)
        var high = ln(largest)
        repeat(HALVINGS) {
            val middle = (low + high) / 2
            if (reach(effect, exp(middle)) < DETECTABLE) low = middle else high = middle
        }
        // Times the strength where the effect is in proportion to it, and times its reach where it has a threshold.
        if (effect !in THRESHOLD) {
            val size = maxOf(exp(high), least[effect] ?: 0.0)
            return (size * multiple).takeIf { it <= largest }
        }
        low = ln(largest * 1e-5)
        high = ln(largest)
        repeat(HALVINGS) {
            val middle = (low + high) / 2
            if (reach(effect, exp(middle)) < DETECTABLE * multiple) low = middle else high = middle
        }
        return exp(high)
    }

    /** √λ of [effect] at [strength]. */
    private fun reach(effect: HiddenEffect, strength: Double): Double = when (effect) {
        HiddenEffect.OUTLIERS -> outliers(strength)
        HiddenEffect.TIME_CONSTANT -> distance(base(timeConstant * exp(strength)))
        HiddenEffect.GAIN_OFFSET -> distance(DoubleArray(clean.size) { clean[it] + strength * (clean[it] - offset) })
        HiddenEffect.QUANTISATION -> distance(rounded(clean, noise.spread, strength * noise.spread))
        else -> distance(readings(mapOf(effect to strength)))
    }

    private fun distance(shown: DoubleArray): Double {
        val difference = DoubleArray(clean.size) { shown[it] - clean[it] }
        if (water != null) return water.distance(difference)
        return sqrt(off(noise.innovations(difference), imitable).sumOf { it * it })
    }

    /** √ of twice the expected log-likelihood ratio of the mixture against the noise alone. */
    private fun outliers(size: Double): Double {
        val share = HiddenNoise.OUTLIER_SHARE
        var sum = 0.0
        val cells = 4000
        val reach = size + 6
        for (k in 0 until cells) {
            val z = reach * (2 * (k + 0.5) / cells - 1)
            val normal = exp(-z * z / 2) / SQRT_2_PI
            val wide = if (z > -size && z < size) 1 / (2 * size) else 0.0
            val mixed = (1 - share) * normal + share * wide
            if (mixed > 0 && normal > 0) sum += mixed * ln(mixed / normal) * 2 * reach / cells
        }
        return sqrt(maxOf(0.0, 2 * clean.size * sum))
    }

    companion object {
        /** The mean over noise of [spread] of what rounding [clean] to [step] shows. */
        fun rounded(clean: DoubleArray, spread: Double, step: Double) = DoubleArray(clean.size) { i ->
            QUANTILES.sumOf { step * Math.rint((clean[i] + spread * it) / step) } / QUANTILES.size
        }

        const val DETECTABLE = 6.36
        private const val HALVINGS = 22
        private const val SQRT_2_PI = 2.5066282746310002
        private val QUANTILES = List(24) { quantile((it + 0.5) / 24) }
        private val THRESHOLD = setOf(
            HiddenEffect.SLEW,
            HiddenEffect.HYSTERESIS,
            HiddenEffect.SATURATION,
            HiddenEffect.QUANTISATION,
            HiddenEffect.OUTLIERS,
        )
        private val LARGEST = mapOf(
            HiddenEffect.TIME_CONSTANT to 1.0,
            HiddenEffect.GAIN_OFFSET to 1.0,
            HiddenEffect.SECOND_ORDER to 60.0,
            HiddenEffect.DEAD_TIME to 60.0,
            HiddenEffect.TWO_PATH to 0.6,
            HiddenEffect.FLOW to 1.5,
            HiddenEffect.TEMPERATURE to 0.2,
            HiddenEffect.SLEW to 20.0,
            HiddenEffect.QUANTISATION to 60.0,
            HiddenEffect.SATURATION to 5.0,
            HiddenEffect.OUTLIERS to 300.0,
            HiddenEffect.POSITION to 30.0,
            HiddenEffect.VALUE_LAG to 1.0,
        )

        /** Quantile of the standard normal by bisection of its series. */
        private fun quantile(p: Double): Double {
            var low = -8.0
            var high = 8.0
            repeat(60) {
                val middle = (low + high) / 2
                if (cumulative(middle) < p) low = middle else high = middle
            }
            return (low + high) / 2
        }

        private fun cumulative(z: Double): Double {
            var term = z
            var sum = z
            var k = 1
            while (k < 200 && kotlin.math.abs(term) > 1e-16) {
                term *= z * z / (2 * k + 1)
                sum += term
                k++
            }
            return 0.5 + sum * exp(-z * z / 2) / SQRT_2_PI
        }
    }
}
