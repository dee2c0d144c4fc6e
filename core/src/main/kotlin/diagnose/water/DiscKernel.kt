package stillwater.diagnose.water

import org.hipparchus.special.BesselJ

/** 2 J₁(x)/x by cubic interpolation: the covariance of waves whose numbers fill a disc. */
internal class DiscKernel {
    private var values = DoubleArray(0)
    private var slopes = DoubleArray(0)

    /** The covariance at [x], dimensionless; 1 at 0. */
    fun at(x: Double): Double {
        if (x > FARTHEST) return 0.0
        val place = x / STEP
        val i = place.toInt()
        if (i + 1 >= values.size) grow(i + 2)
        val t = place - i
        val s = 1 - t
        return s * s * ((1 + 2 * t) * values[i] + t * STEP * slopes[i]) +
            t * t * ((1 + 2 * s) * values[i + 1] - s * STEP * slopes[i + 1])
    }

    private fun grow(least: Int) {
        val from = values.size
        val size = maxOf(least, 2 * from, FIRST)
        values = values.copyOf(size)
        slopes = slopes.copyOf(size)
        if (from == 0) values[0] = 1.0
        for (i in maxOf(from, 1) until size) {
            val x = i * STEP
            val bessel = BesselJ.rjBesl(x, 0.0, ORDERS).getVals()
            values[i] = 2 * bessel[1] / x
            slopes[i] = -2 * bessel[2] / x
        }
    }

    private companion object {
        const val STEP = 0.02

        /** Where it is below a millionth. */
        const val FARTHEST = 5000.0
        const val ORDERS = 3
        const val FIRST = 256
    }
}
