package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.median
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.noise.Shocks
import kotlin.math.ln

/** What is not known of the truth where a sensor is that is not where the boat was, nor will be. */
internal fun interface Swing {
    /**
     * How far the truth [behind] m behind the boat may be off what it was on the way as far back, sensor units, by row; a new
     * array.
     */
    fun doubts(behind: Double): DoubleArray
}

/**
 * Quantities of a log that several models share.
 *
 * @property unknown what its reference leaves open; null where there is none. @property shocks what that does to the
 * reading; null for none. @property doubt what of it they are made for. @property swing what turns leave open of the truth where a
 * sensor is that is off the boat; null for nothing. @property lengthScale of the process by which the truth is told halfway between
 * rows ([FinerTruth]), usual steps; 0 where a spline goes through the rows alone. @param like what has the same of the same log,
 * which is of rows [between] its own; null for none.
 */
internal class Scales private constructor(
    val series: MeasuredSeries,
    val unknown: UnknownTruth?,
    val shocks: Shocks?,
    val doubt: Doubt,
    val swing: Swing?,
    val lengthScale: Double,
    like: Scales?,
    private val between: FinerTruth?,
) {
    private val n = series.size

    constructor(
        series: MeasuredSeries,
        unknown: UnknownTruth? = null,
        shocks: Shocks? = null,
        swing: Swing? = null,
        lengthScale: Double = 0.0,
    ) : this(series, unknown, shocks, Doubt(), swing, lengthScale, null, null)

    /** The same log where what is [unknown] in the same gaps gives the reading these [shocks], made for [doubt]. */
    fun shaken(unknown: UnknownTruth?, shocks: Shocks?, doubt: Doubt = Doubt()) =
        Scales(series, unknown, shocks, doubt, swing, lengthScale, this, null)

    /** The same of a log with rows between. @property rows where the rows of the log are among these. */
    class Finer(val scales: Scales, val rows: IntArray)

    /** What is not known of the same log with another reference, that of [other]; of a sensor on the boat's way. */
    fun of(other: MeasuredSeries) = Scales(other, unknown, shocks, doubt, null, lengthScale, null, null)

    /** The same with the truth halfway between the rows; null where a spline goes through these alone. */
    val finer: Finer? by lazy { if (between != null) null else like?.finer ?: told() }

    private fun told(): Finer? {
        if (lengthScale == 0.0) return null
        val finer = FinerTruth(series, unknown, lengthScale)
        return Finer(Scales(finer.series, finer.unknown, null, doubt, null, 0.0, this, finer), finer.rows)
    }

    /** A column of what this is like in the rows of this; null for null. */
    private fun own(column: DoubleArray?) = column?.let { between?.of(it) ?: it }

    /** Columns of it, by their names. */
    private fun own(columns: Map<String, DoubleArray>?) = columns?.let { between?.of(it) ?: it }

    /** Whether row [i] may be far off for what is not known of the truth before it. */
    fun isInDoubt(i: Int): Boolean = unknown?.isInDoubt(i) == true || shocks?.isShaken(i) == true ||
        (doubt.between != null && shocks?.isShakenNear(i) == true)

    /** White noise where [rows] are in use, and what is not known of the sensor's state. */
    fun white(rows: BooleanArray) = CorrelatedNoise(series.times, 0.0, 1.0, rows, shocks)

    /** Speed that counts as ordinary, m/s. */
    val ordinarySpeed: Double = like?.ordinarySpeed ?: maxOf(ordinary(series.speed), SLOWEST)

    /** Log of speed over the ordinary, as the lag takes it. */
    val logSpeed: DoubleArray =
        own(like?.logSpeed) ?: DoubleArray(n) { ln((series.speed[it] / ordinarySpeed).coerceIn(0.01, 100.0)) }

    /** Temperature that counts as ordinary, °C. */
    val ordinaryTemperature: Double =
        like?.ordinaryTemperature ?: series.temperature?.let(::median) ?: Double.NaN

    /** Temperature over the ordinary, °C; 0 where there is none. */
    val warmth: DoubleArray =
        own(like?.warmth) ?: DoubleArray(n) { i -> series.temperature?.let { it[i] - ordinaryTemperature } ?: 0.0 }

    /** What each condition is centred on. */
    val middles: Map<String, Double>

    /** Each condition less its middle. */
    val centred: Map<String, DoubleArray>

    init {
        val bridged by lazy { series.conditions.keys.associateWith { checkNotNull(series.filled(it)) } }
        middles = like?.middles ?: bridged.mapValues { (_, column) -> median(column) }
        centred = own(like?.centred)
            ?: bridged.mapValues { (name, column) -> DoubleArray(n) { column[it] - middles.getValue(name) } }
    }

    /** The same without most of its own noise and rounding, which a reading does not show. */
    val quiet: Map<String, DoubleArray> by lazy {
        val isGap = unknown?.isGap ?: BooleanArray(n)
        own(like?.quiet) ?: centred.mapValues { (_, column) -> ReferenceNoise(series.times, column, isGap).smoothed() }
    }

    /** The track as times of ways. */
    val way: WayTimes by lazy { like?.way?.takeIf { between == null } ?: WayTimes(series) }

    /** Finest step between different values, sensor units; 0 where there is none. */
    val resolution: Double = like?.resolution ?: Resolution.of(series.shown(series.values))

    /** From the lowest to the highest reading, sensor units. */
    val range: Double =
        like?.range ?: series.shown(series.values).let { (it.maxOrNull() ?: 0.0) - (it.minOrNull() ?: 0.0) }

    companion object {
        private const val SLOWEST = 0.01

        /** Of the speed that only one row in twenty exceeds: a boat that is slower stands. */
        private const val STANDING = 0.1
        private const val FAST = 0.95

        /** Median of [speeds], m/s; of a boat that stands most of the time, of when it does not. */
        private fun ordinary(speeds: DoubleArray): Double {
            val standing = STANDING * speeds.sortedArray().let { it[(FAST * (it.size - 1)).toInt()] }
            val usual = median(speeds)
            return if (usual < standing) median(speeds.filter { it >= standing }.toDoubleArray()) else usual
        }
    }
}
