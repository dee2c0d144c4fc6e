package stillwater.diagnose.blind

import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.Scales
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes

/** What a log has whatever its readings are, where the boat was on [track]. */
internal class BlindGround(
    series: MeasuredSeries,
    loops: Loops,
    val track: SmoothTrack = SmoothTrack.of(series),
) {
    val scales = Scales(series)
    val fixes = FixScatter(series, track, scales.resolution)
    val steep = SteepNoise(fixes)
    val designs = BlindColumns(series, scales, loops)
    private val few = (series.size / 5).coerceIn(BlindSearch.FEWEST_WAVES, BlindSearch.MOST_WAVES / 2)
    val rough = WaterModes.flat(series, track, few, loops = loops)
}
