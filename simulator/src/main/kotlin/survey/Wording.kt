package stillwater.survey

import stillwater.report.SignificantDigits
import java.util.Locale

/**
 * Numbers and units of a [SurveyMap] in words.
 *
 * @param map the map.
 */
internal class Wording(private val map: SurveyMap) {
    /** What positions are counted in: m, or the units of the only coordinate of a transect. */
    val length: String = map.log.lengthUnit

    /** What speeds are counted in. */
    val speed: String = map.log.speedUnit

    /** The quantity with its unit, where the user gave one, for legends and titles. */
    val quantity: String = map.unit?.let { "${map.log.quantity} ($it)" } ?: map.log.quantity

    /** [value] of the quantity with its unit, where there is one. */
    fun value(value: Double): String = digits(value) + after

    /** Mean and standard error of the quantity; without the error where too few legs show it. */
    fun estimate(estimate: Estimate): String {
        val error = if (estimate.standardError.isNaN()) "" else " ± ${digits(estimate.standardError, 2)}"
        return "${digits(estimate.mean)}$error$after"
    }

    /** The unit after a number, with a blank before it; empty without one. */
    val after: String get() = map.unit?.let { " $it" }.orEmpty()

    companion object {
        private const val MINUTE = 60.0
        private const val HOUR = 3600.0
        private const val PERCENT = 100.0

        /** [value] with [count] significant digits and no zeros behind them. */
        fun digits(value: Double, count: Int = 4): String = SignificantDigits(count).format(value)
            .let { if ('.' in it && 'e' !in it) it.trimEnd('0').trimEnd('.') else it }

        /** [seconds] in s, and in min or h where that is easier to read. */
        fun duration(seconds: Double): String {
            val rounded = "${digits(seconds)} s"
            return when {
                seconds >= 2 * HOUR -> "$rounded (${digits(seconds / HOUR)} h)"
                seconds >= 2 * MINUTE -> "$rounded (${digits(seconds / MINUTE)} min)"
                else -> rounded
            }
        }

        /** [share], 0 to 1, in percent. */
        fun percent(share: Double): String = String.format(Locale.ROOT, "%.1f %%", PERCENT * share)
    }
}
