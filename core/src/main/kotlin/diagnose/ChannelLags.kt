package stillwater.diagnose

import stillwater.diagnose.blind.BlindDiagnosis
import stillwater.diagnose.blind.BlindErrors
import stillwater.model.Interval
import kotlin.math.sqrt

/**
 * How late one channel of a log is, as a dead time, by what slow waves of the water show: of a truth that is held over each
 * row, by half a row less, or more, than the dead time beside it.
 *
 * @property name its column. @property delay s; NaN where the log does not show it. @property error its standard error,
 * s.
 */
public class ChannelLag internal constructor(
    public val name: String,
    public val delay: Double,
    internal val error: Double,
) {
    /** Whether the log shows that the channel is late. */
    public val isSeen: Boolean get() = delay.isFinite()

    /** Where the delay lies at 95 %, s; null where none is seen. */
    public val interval: Interval? get() =
        if (isSeen) ends(delay, error) else null

    internal companion object {
        /** The interval of 95 % about a delay of [seconds] with the standard error [error], s. */
        fun ends(seconds: Double, error: Double): Interval {
            val reach = BlindErrors.REACH * error
            return Interval(maxOf(seconds - reach, 0.0), seconds + reach)
        }
    }
}

/**
 * What of a channel's lag is its sensor's own: channels that share clock, receiver and place on the boat are late alike
 * by what those do, so that no more can be common to all than the lag of the quickest.
 *
 * @property channels all, the diagnosed one first.
 */
public class ChannelLags private constructor(public val channels: List<ChannelLag>) {
    private val first = channels.first()

    /** The quickest of the others whose lag is seen; null where none is. */
    public val quickest: ChannelLag? = channels.drop(1).filter { it.isSeen }.minByOrNull { it.delay }

    /** The most of the first channel's lag that can be common to all, s; null where too little is seen. */
    public val common: Double? = quickest?.takeIf { first.isSeen }?.let { minOf(it.delay, first.delay) }

    /** What the first channel's sensor adds at least, s; null where too little is seen. */
    public val own: Double? = common?.let { first.delay - it }

    /** Where [own] lies at 95 %, s. */
    public val ownInterval: Interval? = own?.let {
        val other = checkNotNull(quickest).error
        ChannelLag.ends(it, sqrt(first.error * first.error + other * other))
    }

    public companion object {
        /**
         * Learns the lags of the channel in [series], called [name], and of [others], columns of the same rows by name,
         * NaN where a row has none. What [diagnosed], the diagnosis of [series], has found is not searched again;
         * [loops] says how what can be done at once is, and [progress] is told how much is done, a share within 0..1
         * that grows.
         */
        public fun of(
            series: MeasuredSeries,
            name: String,
            others: Map<String, DoubleArray>,
            diagnosed: DiagnosisResult? = null,
            loops: Loops = Loops.IN_TURN,
            progress: (Double) -> Unit = {},
        ): ChannelLags {
            val own = diagnosed?.lag?.let { ChannelLag(name, it.delay, it.error) } ?: lag(name, series, loops)
            return ChannelLags(
                listOf(own) + others.entries.mapIndexed { i, (other, column) ->
                    lag(other, series.withValues(column), loops) { progress((i + it) / others.size) }
                },
            )
        }

        private fun lag(
            name: String,
            series: MeasuredSeries,
            loops: Loops,
            progress: (Double) -> Unit = {},
        ): ChannelLag = BlindDiagnosis(series.fromStart(), DiagnosisSettings(), loops, progress).channel(name)
    }
}
