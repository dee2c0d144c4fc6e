package stillwater.diagnose.algebra

/** Interpolation by the polynomial through some points. */
internal object Lagrange {
    /** The polynomial through [rows] of [column], which is known at [times], at [time]. */
    fun through(times: DoubleArray, column: DoubleArray, rows: IntArray, time: Double): Double {
        var sum = 0.0
        for (k in rows) sum += column[k] * weight(times, rows, k, time)
        return sum
    }

    /** Lagrange's weight of row [k] among [from] at [time]. */
    private fun weight(times: DoubleArray, from: IntArray, k: Int, time: Double): Double {
        var product = 1.0
        for (j in from) if (j != k) product *= (time - times[j]) / (times[k] - times[j])
        return product
    }
}
