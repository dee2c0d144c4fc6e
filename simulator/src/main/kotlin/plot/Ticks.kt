package stillwater.plot

import java.math.BigDecimal
import java.math.MathContext
import java.math.RoundingMode
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.floor
import kotlin.math.log10
import kotlin.math.pow

/**
 * Where an axis is marked, and with which words.
 *
 * @property places the marked values, ascending. @property labels their texts, as many.
 */
internal class Ticks private constructor(val places: List<Double>, val labels: List<String>) {
    internal companion object {
        private const val TEN = 10.0
        private const val ROUNDING = 1e-9
        private const val LARGE = 1e6
        private const val SMALL = 1e-4
        private const val DIGITS = 4
        private const val FEWEST = 3
        private val steps = doubleArrayOf(1.0, 2.0, 5.0, 10.0)
        private val mantissas = listOf(
            doubleArrayOf(1.0, 2.0, 3.0, 5.0),
            doubleArrayOf(1.0, 2.0, 5.0),
            doubleArrayOf(1.0, 3.0),
            doubleArrayOf(1.0),
        )
        private val fine = doubleArrayOf(1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)

        /** At most [most] multiples of 1, 2 or 5 times a power of ten, from [from] to [to]. */
        fun linear(from: Double, to: Double, most: Int): Ticks {
            val step = roundStep((to - from) / most)
            val first = ceil(from / step - ROUNDING)
            val last = floor(to / step + ROUNDING)
            // Too fine for doubles of this size: the ends are all that can be told apart.
            if (!step.isFinite() || step < Math.ulp(maxOf(abs(from), abs(to)))) return bare(listOf(from, to).distinct())
            val count = (last - first).toInt() + 1
            val places = List(count) { (first + it) * step }
            val decimals = maxOf(0, -floor(log10(step) + ROUNDING).toInt())
            val large = maxOf(abs(from), abs(to)) >= LARGE
            if (large || step < SMALL) return bare(places)
            return Ticks(places, places.map { typeset(BigDecimal(it).setScale(decimals, RoundingMode.HALF_EVEN)) })
        }

        /**
         * At most [most] round numbers on a logarithmic axis from [from] to [to], both positive; an end that is 0 or
         * infinite counts as the smallest or largest number.
         */
        fun log(from: Double, to: Double, most: Int): Ticks {
            val low = from.coerceIn(java.lang.Double.MIN_NORMAL, Double.MAX_VALUE)
            val high = to.coerceIn(java.lang.Double.MIN_NORMAL, Double.MAX_VALUE)
            val powers = floor(log10(low)).toInt()..floor(log10(high)).toInt()
            fun among(digits: DoubleArray) = powers
                .flatMap { power -> digits.map { BigDecimal(it).scaleByPowerOfTen(power).toDouble() } }
                .filter { it >= low * (1 - ROUNDING) && it <= high * (1 + ROUNDING) && it.isFinite() }
            val sets = mantissas.map(::among)
            val set = sets.firstOrNull { it.size <= most } ?: sets.last().let { all ->
                all.filterIndexed { index, _ -> index % (all.size / most + 1) == 0 }
            }
            val places = if (set.size >= FEWEST) set else among(fine).takeIf { it.size in FEWEST..most } ?: set
            return if (places.size < 2) linear(low, high, FEWEST) else bare(places)
        }

        private fun bare(places: List<Double>) = Ticks(places, places.map(::label))

        private fun roundStep(wanted: Double): Double {
            val power = TEN.pow(floor(log10(wanted)))
            return (steps.firstOrNull { it * power >= wanted * (1 - ROUNDING) } ?: steps.last()) * power
        }

        private fun label(value: Double): String {
            if (value == 0.0) return "0"
            val short = BigDecimal(value).round(MathContext(DIGITS)).stripTrailingZeros()
            if (abs(value) < LARGE && abs(value) >= SMALL) return typeset(short)
            val power = short.precision() - short.scale() - 1
            return typeset(short.movePointLeft(power)) + "e$power"
        }

        private fun typeset(number: BigDecimal) = number.toPlainString().replace('-', '−')
    }
}
