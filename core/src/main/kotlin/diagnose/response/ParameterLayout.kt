package stillwater.diagnose.response

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries

/** The numbers of the base that are wrong where this is the cause: indices into a model's numbers. */
internal val Cause.baseNumbers: List<Int>
    get() = when (this) {
        Cause.TIME_CONSTANT -> listOf(ResponseModel.TIME_CONSTANT)
        Cause.GAIN_OFFSET -> listOf(ResponseModel.GAIN, ResponseModel.OFFSET)
        else -> emptyList()
    }

/**
 * The number of a given sensor that is known for one speed, temperature, time or other condition only once this cause
 * is at work: an index into a model's numbers; null for none. Which condition the sensor was calibrated at is not said.
 */
internal val Cause.conditionalNumber: Int?
    get() = when (this) {
        Cause.FLOW_DEPENDENT_RESPONSE, Cause.TEMPERATURE_DEPENDENT_RESPONSE -> ResponseModel.TIME_CONSTANT
        Cause.CROSS_SENSITIVITY, Cause.DRIFT -> ResponseModel.OFFSET
        else -> null
    }

/** Whether this shows in how the reading follows the truth from row to row. */
internal val Cause.isTiming: Boolean
    get() = when (this) {
        Cause.ASYMMETRIC_RESPONSE,
        Cause.SECOND_ORDER_RESPONSE,
        Cause.TWO_PATH_RESPONSE,
        Cause.DEAD_TIME,
        Cause.SLEW_LIMIT,
        Cause.FLOW_DEPENDENT_RESPONSE,
        Cause.TEMPERATURE_DEPENDENT_RESPONSE,
        Cause.HYSTERESIS,
        Cause.POSITION_OFFSET,
        -> true
        else -> false
    }

/** Which number of a model stands where. */
internal class ParameterLayout(series: MeasuredSeries, terms: List<Term>, scales: Scales) {
    /** Index of the first parameter of each term, by its key. */
    val slots: Map<String, Int>

    /** Number of parameters of each term, by its key. */
    val widths: Map<String, Int>

    /** All parameters in order. */
    val parameters: List<Parameter>

    /** The track as times of ways. */
    val way: WayTimes by lazy { WayTimes(series) }

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

/** When the boat was a way further or less far along its track. */
internal class WayTimes(private val series: MeasuredSeries) {
    private val smooth: DoubleArray = smoothed()

    /** The way as the sum of smoothed speeds: jitter of fixes would make it too long. */
    private fun smoothed(): DoubleArray {
        val way = DoubleArray(series.size)
        for (i in 1 until series.size) {
            val dt = series.times[i] - series.times[i - 1]
            way[i] = way[i - 1] + maxOf((series.speed[i] + series.speed[i - 1]) / 2 * dt, 1e-9)
        }
        return way
    }

    /** The times at which the way was [distance] m further than at each row, asked for row after row. */
    fun at(distance: Double): Walk = Walk(distance)

    /** Goes along the track [distance] m ahead of the rows. */
    inner class Walk(private val distance: Double) {
        private var after = 0

        /** The time that belongs to row [i], no earlier than the last one asked for, s; the last time beyond the end. */
        fun timeAt(i: Int): Double {
            val times = series.times
            val wanted = smooth[i] + distance
            while (after < smooth.size && smooth[after] < wanted) after++
            if (after == smooth.size) return times.last()
            if (smooth[after] == wanted) return times[after]
            if (after == 0) return times[0] + (wanted - smooth[0]) / maxOf(series.speed[0], 0.01)
            val share = (wanted - smooth[after - 1]) / (smooth[after] - smooth[after - 1])
            return times[after - 1] + share * (times[after] - times[after - 1])
        }
    }
}
