package stillwater.diagnosis

import stillwater.diagnose.ChannelLag
import stillwater.diagnose.ChannelLags
import stillwater.report.SignificantDigits

/** Lags of channels in words. */
internal object ChannelWording {
    private val three = SignificantDigits(3)

    /** What [lags] say about the first channel, one sentence or two. */
    fun of(lags: ChannelLags): String {
        val all = lags.channels.joinToString("; ") { seconds(it) }
        val common = lags.common
        val own = lags.own
        val reach = lags.ownInterval
        val rest = if (common == null || own == null || reach == null) {
            "What of it is common to all channels cannot be told."
        } else {
            "At most ${three.format(common)} s can be common to all channels (antenna, receiver or clock); at least " +
                "${three.format(own)} s [${three.format(reach.lower)}, ${three.format(reach.upper)}] are the " +
                "sensor's own."
        }
        return "Lags as dead times: $all. $rest"
    }

    private fun seconds(lag: ChannelLag): String = lag.interval.let { reach ->
        if (reach == null) {
            "${lag.name} none seen"
        } else {
            "${lag.name} ${three.format(lag.delay)} s [${three.format(reach.lower)}, ${three.format(reach.upper)}]"
        }
    }
}
