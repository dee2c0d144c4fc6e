package stillwater.diagnose

/** What a log has whatever its readings are, which were taken along [track]. */
internal class BlindGround(series: MeasuredSeries, val track: SmoothTrack, loops: Loops) {
    val scales = Scales(series)
    val designs = BlindColumns(series, scales, loops)
    private val few = (series.size / 5).coerceIn(BlindSearch.FEWEST_WAVES, BlindSearch.MOST_WAVES / 2)
    val rough = WaterModes.flat(series, track, few, loops = loops)
}
