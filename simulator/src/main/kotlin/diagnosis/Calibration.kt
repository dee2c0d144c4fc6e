package stillwater.diagnosis

import stillwater.diagnose.Estimate
import stillwater.report.SignificantDigits
import kotlin.math.abs

/**
 * Gain and offset of a sensor against its reference, for the reader: the base model fits them, so that they are no
 * cause, but who has the log wants to know that the sensor reads high.
 */
internal class Calibration(private val diagnosed: Diagnosed) {
    private val model = diagnosed.result.extended ?: diagnosed.result.baseline
    private val gain = number("gain")
    private val offset = number("offset")
    private val three = SignificantDigits(3)

    private fun number(name: String): Estimate? = model.parameters.firstOrNull { it.name == name }

    /**
     * The two numbers and what they do at the ends of what the reference shows; null where they were given, where their
     * intervals hold 1 and 0, or where what they do is nowhere more than the readings scatter or sums are rounded.
     */
    fun words(): String? {
        val gain = gain ?: return null
        val offset = offset ?: return null
        if (!isOff(gain, 1.0) && !isOff(offset, 0.0)) return null
        val truth = diagnosed.log.columns.reference.filter { it.isFinite() }
        val ends = listOfNotNull(truth.minOrNull(), truth.maxOrNull())
        val errors = ends.map { (gain.value - 1) * it + offset.value }
        val rounding = ROUNDING * ends.maxOf { abs(it) }
        if (errors.all { abs(it) <= maxOf(model.trainRmse, rounding) }) return null
        // Of a reference that never changes a gain is not known.
        val numbers = if (ends.distinct().size < 2) {
            ""
        } else {
            "gain ${diagnosed.number(gain)}, offset ${diagnosed.number(offset)}; "
        }
        return "calibration against the reference: ${numbers}the sensor reads " +
            ends.indices.map { high(errors[it], ends[it]) }.distinct().joinToString(" and ")
    }

    private fun isOff(estimate: Estimate, neutral: Double) =
        estimate.interval?.let { neutral !in it.lower..it.upper } == true

    /** [error] where the truth is [value], in words. */
    private fun high(error: Double, value: Double): String {
        val side = if (error < 0) "low" else "high"
        val share = if (abs(value) > abs(error)) " (${three.format(100 * abs(error / value))} %)" else ""
        val size = three.format(abs(error)) + diagnosed.unitAfter
        return "$size too $side$share where the reference shows ${three.format(value)}"
    }

    private companion object {
        /** What sums over a log may lose, of the readings; a log without noise shows it. */
        const val ROUNDING = 1e-9
    }
}
