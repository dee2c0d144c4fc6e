package stillwater.diagnose.water

/**
 * A smooth function of a distance by cubic interpolation between its values at multiples of [step], m, each of which is
 * found when it is first needed.
 */
internal class DistanceCurve(private val step: Double, private val value: (Double) -> Double) {
    private var values = DoubleArray(FIRST) { Double.NaN }

    /** The value at [distance], m, at least 0. */
    fun at(distance: Double): Double {
        val place = distance / step
        val i = place.toInt()
        if (i + 2 >= values.size) grow(i + 3)
        // Even about 0.
        val before = node(if (i == 0) 1 else i - 1)
        val here = node(i)
        val next = node(i + 1)
        val after = node(i + 2)
        val t = place - i
        val s = 1 - t
        // Lagrange's cubic through the four.
        return s * here * (1 + t) * (2 - t) / 2 + t * next * (1 + t) * (2 - t) / 2 -
            t * s * ((2 - t) * before + (1 + t) * after) / 6
    }

    private fun node(i: Int): Double {
        val known = values[i]
        if (!known.isNaN()) return known
        return value(i * step).also { values[i] = it }
    }

    private fun grow(least: Int) {
        val from = values.size
        values = values.copyOf(maxOf(least, 2 * from))
        values.fill(Double.NaN, from)
    }

    private companion object {
        const val FIRST = 1024
    }
}
