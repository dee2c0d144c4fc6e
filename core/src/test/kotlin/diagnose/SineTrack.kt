package stillwater.diagnose

import stillwater.diagnose.blind.BlindColumns
import stillwater.diagnose.blind.BlindFit
import stillwater.diagnose.blind.BlindNoise
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import kotlin.math.sin

/** A way of [rows] rows, one a second, that crosses itself, and a few waves of water along it. */
internal class SineTrack(private val rows: Int) {
    /** Readings that are a sine of time. */
    val series = MeasuredSeries(
        DoubleArray(rows) { it.toDouble() },
        DoubleArray(rows) { 15 * sin(it / 9.0) },
        DoubleArray(rows) { 15 * sin(it / 13.0 + 1) },
        DoubleArray(rows) { sin(it / 7.0) },
        null,
    )

    /** The water behind a lag of 4 s, in noise that wanders and is uneven, of which only the rows [used] count. */
    fun fit(used: BooleanArray): BlindFit {
        val noise = BlindNoise(CorrelatedNoise(series.times, 0.6, 5.0, used), DoubleArray(rows) { 1.0 + it % 2 })
        val waves = WaterModes.flat(series, SmoothTrack.of(series), 30)
        val columns = BlindColumns(series, Scales(series), Loops.IN_TURN)
        val shown = columns.shown(emptyList(), doubleArrayOf(4.0, 1.0, 0.0, 0.0), waves, Steps.EVEN)
        val design = columns.designed(shown, null, noise)
        return BlindFit(design, DoubleArray(design.size) { 0.1 + it % 3 }, DoubleArray(design.size))
    }
}
