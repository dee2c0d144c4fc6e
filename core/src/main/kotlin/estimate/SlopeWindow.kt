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
}
