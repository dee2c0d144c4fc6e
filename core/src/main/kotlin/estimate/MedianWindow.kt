package stillwater.estimate

/**
 * The running median of the last [size] samples, which passes a monotone signal unchanged and drops single outliers.
 *
 * The median stands for the time of the middle sample, so a steady ramp keeps its timing. O([size]) a sample, no
 * allocation. Source: the report, section 5 and Algorithm 1, MedianFilter.
 *
 * @property size samples in the window, odd, at least 1.
 * @throws IllegalArgumentException if [size] is even or below 1.
 */
public class MedianWindow(public val size: Int) {
    init {
        require(size >= 1 && size % 2 == 1) { "median window ($size samples) must be odd and at least 1" }
    }

    private val times = DoubleArray(size)
    private val ring = DoubleArray(size)
    private val sorted = DoubleArray(size)
    private var count = 0
    private var next = 0

    /** Whether [size] samples have come since the start or the last [clear]. */
    public val full: Boolean get() = count == size

    /** Median of the samples, sensor units. Meaningful once [full]. */
    public val median: Double
        get() = if (size == THREE) middle(ring[0], ring[1], ring[2]) else sorted[size / 2]

    /** Time of the middle sample, s. Meaningful once [full]. */
    public val time: Double
        get() {
            val place = next + size / 2
            return times[if (place < size) place else place - size]
        }

    /** Forgets all samples. */
    public fun clear() {
        count = 0
        next = 0
    }

    /** Adds the sample [value], sensor units, taken at [seconds] s; drops the oldest when [full]. Both finite. */
    public fun add(seconds: Double, value: Double) {
        if (size != THREE) {
            sort(ring[next], value)
        } else if (count < THREE) {
            count++
        }
        ring[next] = value
        times[next] = seconds
        next = if (next + 1 == size) 0 else next + 1
    }

    private fun sort(leaving: Double, value: Double) {
        // Shift the sorted values between the leaving and the entering one by a place.
        var place: Int
        if (count == size) {
            place = 0
            while (sorted[place] != leaving) place++
        } else {
            place = count++
        }
        while (place > 0 && sorted[place - 1] > value) {
            sorted[place] = sorted[place - 1]
            place--
        }
        while (place < count - 1 && sorted[place + 1] < value) {
            sorted[place] = sorted[place + 1]
            place++
        }
        sorted[place] = value
    }

    internal companion object {
        /** The report's window, for which nothing need be kept in order. */
        private const val THREE = 3

        /** The median of three. */
        fun middle(a: Double, b: Double, c: Double): Double = if (a < b) {
            if (c < a) {
                a
            } else if (c < b) {
                c
            } else {
                b
            }
        } else {
            if (c < b) {
                b
            } else if (c < a) {
                c
            } else {
                a
            }
        }
    }
}
