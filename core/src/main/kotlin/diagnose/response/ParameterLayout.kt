package stillwater.diagnose.response

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries

/** Which number of a model stands where. */
internal class ParameterLayout(series: MeasuredSeries, terms: List<Term>, scales: Scales) {
    /** Index of the first parameter of each term, by its key. */
    val slots: Map<String, Int>

    /** Number of parameters of each term, by its key. */
    val widths: Map<String, Int>

    /** All parameters in order. */
    val parameters: List<Parameter>

    init {
        val list = ArrayList<Parameter>()
        val places = LinkedHashMap<String, Int>()
        val longest = maxOf(series.duration, series.period)
        list += Parameter("time_constant_s", "s", true, series.period / 50, longest)
        list += Parameter("gain", "", false, -1e6, 1e6)
        list += Parameter("offset", "sensor units", false, -1e12, 1e12)
        list += Parameter("initial_deviation", "sensor units", false, -1e12, 1e12)
        for (term in terms) {
            places[term.key] = list.size
            list += of(term, longest, series, scales)
            if (term.hasOwnStart) list += ownStart(term.cause)
        }
        slots = places
        widths = places.keys.zip(places.values.zip(places.values.drop(1) + list.size) { from, to -> to - from }).toMap()
        parameters = list
    }

    private fun of(term: Term, longest: Double, series: MeasuredSeries, scales: Scales): List<Parameter> {
        val range = maxOf(scales.range, 1e-12)
        return when (term.cause) {
            Cause.ASYMMETRIC_RESPONSE -> listOf(Parameter("log_ratio", "", false, -3.0, 3.0, 0.0))
            Cause.SECOND_ORDER_RESPONSE ->
                listOf(Parameter("second_time_constant_s", "s", true, SHORTEST * series.period, longest))
            Cause.TWO_PATH_RESPONSE -> listOf(
                Parameter("slow_ratio", "", true, 1.05, 300.0),
                Parameter("slow_share", "", false, 0.0, 0.95, 0.0),
            )
            Cause.DEAD_TIME -> {
                val least = if (term.isEitherWay) -longest / 4 else 0.0
                listOf(Parameter("dead_time_s", "s", false, least, longest / 4, 0.0))
            }
            Cause.SLEW_LIMIT -> listOf(Parameter("rate_per_s", "sensor units/s", true, 1e-12 * range, 1e6 * range))
            Cause.FLOW_DEPENDENT_RESPONSE -> listOf(Parameter("exponent", "", false, -2.0, 2.0, 0.0))
            Cause.TEMPERATURE_DEPENDENT_RESPONSE ->
                listOf(Parameter("relative_change_per_deg_c", "1/°C", false, -0.5, 0.5, 0.0))
            Cause.CROSS_SENSITIVITY ->
                listOf(Parameter("coefficient", "sensor units per unit", false, -1e12, 1e12, 0.0))
            Cause.DRIFT -> listOf(Parameter("rate_per_s", "sensor units/s", false, -1e12, 1e12, 0.0))
            Cause.OFFSET_STEPS ->
                term.times.indices.map { Parameter("jump_${it + 1}", "sensor units", false, -1e12, 1e12, 0.0) }
            Cause.HYSTERESIS -> listOf(Parameter("width", "sensor units", true, 1e-9 * range, 2 * range))
            Cause.QUANTISATION -> {
                val step = if (scales.resolution > 0) scales.resolution else range
                listOf(Parameter("spread", "sensor units", true, 1e-2 * step, 1e3 * step))
            }
            Cause.SATURATION -> listOf(
                Parameter("lower", "sensor units", false, -1e12, 1e12),
                Parameter("upper", "sensor units", false, -1e12, 1e12),
            )
            Cause.POSITION_OFFSET -> listOf(Parameter("behind_m", "m", false, -1e4, 1e4, 0.0))
            else -> emptyList()
        }
    }

    /** Of a play it is where in its width it is, else a height of what the part adds until it has settled. */
    private fun ownStart(cause: Cause) = if (cause == Cause.HYSTERESIS) {
        Parameter(OWN_START, "", false, -0.5, 0.5, 0.0)
    } else {
        Parameter(OWN_START, "sensor units", false, -1e12, 1e12, 0.0)
    }

    private companion object {
        const val OWN_START = "own_start"

        /** The second of two lags, in rows: one that shows may be a fiftieth of a row where the noise is small. */
        const val SHORTEST = 2e-4
    }
}
