package stillwater.diagnose.blind

import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.three
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.ln

/**
 * The lags that the halves of a log without a reference have, each with water of its own.
 *
 * Water that is let change in time makes up for a lag that does: each half then has its own.
 */
internal class LagOfHalves(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val loops: Loops,
) {
    /** In words, that the two differ for certain; null where they do not, or where one half does not show its lag. */
    fun words(): String? {
        val middle = series.size / 2
        val (first, second) = listOf(series.part(0, middle), series.part(middle, series.size)).map { half ->
            BlindDiagnosis(half, settings, loops).timeConstant() ?: return null
        }
        val apart = abs(ln(first.seconds / second.seconds))
        if (apart < CERTAIN * hypot(first.error, second.error)) return null
        return "the lag is ${three(first.seconds)} s in the first half of the log and ${three(second.seconds)} s in " +
            "the second"
    }

    private companion object {
        /** Standard errors by which the two differ by chance in one log of ten thousand: Student's t, 23 degrees of freedom. */
        const val CERTAIN = 4.7
    }
}

/** A time constant of so many [seconds], which may be off by [error] on a logarithmic scale. */
internal class FoundLag(val seconds: Double, val error: Double)
