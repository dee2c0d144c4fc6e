package stillwater.estimate

/**
 * The least-squares slope of the last [size] values against their times, for steps of any length.
 *
 * slope = Σ (t − t̄)(v − v̄) / Σ (t − t̄)². O([size]), no allocation. Source: the report, section 5 and Algorithm 1,
 * LinearRegression. Differs: uses the times, where the report counts samples.
 *
 * @property size values in the window, at least 2.
 * @throws IllegalArgumentException if [size] is below 2.
 */
public class SlopeWindow(public val size: Int) {
    init {
        require(size >= 2) { "slope window ($size values) must be at least 2" }
    }

    private val times = DoubleArray(size)
    private val values = DoubleArray(size)
    private var count = 0
    private var next = 0

    /** Whether [size] values have come since the start or the last [clear]. */
    public val full: Boolean get() = count == size

    /** Forgets all values. */
    public fun clear() {
        count = 0
        next = 0
    }

    /** Adds [value], sensor units, of the time [seconds], s; drops the oldest when [full]. Both finite. */
    public fun add(seconds: Double, value: Double) {
        times[next] = seconds
        values[next] = value
        next = if (next + 1 == size) 0 else next + 1
        if (count < size) count++
    }

    /** Σ (t − t̄)² of the values that the last [slope] was taken over, s². */
    internal var timeSpread: Double = 0.0
        private set

    /** Slope, sensor units/s; 0 when there are fewer than two values or all have one time. */
    public fun slope(): Double {
        if (count < 2) return 0.0
        if (count == FIVE && size == FIVE) return slopeOfFive()
        // Differences from one member of the window keep large stamps from costing digits.
        val time0 = times[0]
        val value0 = values[0]
        var sumTime = 0.0
        var sumValue = 0.0
        for (i in 0 until count) {
            sumTime += times[i] - time0
            sumValue += values[i] - value0
        }
        val meanTime = sumTime / count
        val meanValue = sumValue / count
        var covariance = 0.0
        var variance = 0.0
        for (i in 0 until count) {
            val time = times[i] - time0 - meanTime
            covariance += time * (values[i] - value0 - meanValue)
            variance += time * time
        }
        timeSpread = variance
        return if (variance > 0) covariance / variance else 0.0
    }

    /** The same sums in the same order without a loop: the report's window, half of all its filter's time. */
    private fun slopeOfFive(): Double {
        val t1 = times[1] - times[0]
        val t2 = times[2] - times[0]
        val t3 = times[3] - times[0]
        val t4 = times[4] - times[0]
        val v1 = values[1] - values[0]
        val v2 = values[2] - values[0]
        val v3 = values[3] - values[0]
        val v4 = values[4] - values[0]
        val meanTime = (t1 + t2 + t3 + t4) / FIVE
        val meanValue = (v1 + v2 + v3 + v4) / FIVE
        val d0 = -meanTime
        val d1 = t1 - meanTime
        val d2 = t2 - meanTime
        val d3 = t3 - meanTime
        val d4 = t4 - meanTime
        val covariance = d0 * -meanValue + d1 * (v1 - meanValue) + d2 * (v2 - meanValue) +
            d3 * (v3 - meanValue) + d4 * (v4 - meanValue)
        val variance = d0 * d0 + d1 * d1 + d2 * d2 + d3 * d3 + d4 * d4
        timeSpread = variance
        return if (variance > 0) covariance / variance else 0.0
    }

    private companion object {
        const val FIVE = 5
    }
}
