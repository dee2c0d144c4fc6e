package stillwater.diagnose.evidence

import stillwater.diagnose.MeasuredSeries
import java.util.Locale
import kotlin.math.exp

/** An offset that settles, as of a probe that warms up. */
internal object Settling {
    /** Over the log's duration, within which it is to settle. */
    val TIMES = listOf(0.02, 0.03, 0.05, 0.08, 0.12, 0.18, 0.25, 0.33)

    /** Time constants after which 95 % is done. */
    private const val SETTLED = 3.0

    /** An offset of [series] that moves from 0 to 1 and has settled after some [time], s. */
    fun column(series: MeasuredSeries, time: Double): DoubleArray =
        DoubleArray(series.size) { 1 - exp(-(series.times[it] - series.times[0]) / time) }

    /** An offset that moves by [size] with [time], s, for the reader. */
    fun words(size: Double, time: Double): String =
        "an offset that moves by %.2g and settles within some %.2g s".format(Locale.ROOT, size, SETTLED * time) +
            ", as of a probe that warms up or is overgrown"
}
