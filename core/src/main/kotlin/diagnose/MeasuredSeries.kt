package stillwater.diagnose

import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.atan2
import kotlin.math.hypot

/**
 * A log as columns: what the diagnosis works on.
 *
 * Rows are in strictly growing time. Arrays are retained and must not be changed.
 *
 * @property times when each sample was taken, s, length n, finite and strictly ascending.
 * @property x metres east, length n, finite. @property y metres north, length n, finite.
 * @property values what the sensor said, sensor units, length n, finite.
 * @property reference the truth up to noise, sensor units, length n, finite; null where it is unknown.
 * @property conditions further columns by name, each of length n, NaN where unknown, which is bridged as
 *   [ConditionGaps] does; without a speed it is taken from the positions.
 * @property isSparse whether rows were left out because their reference is not known, so that the truth between the
 *   rows must be guessed.
 * @property isRead whether the sensor's reading in each row is known, length n; null where all are. The truth in the other
 *   rows is what the sensor has seen; their values count for nothing.
 * @property wild by how much the readings that are far beyond all others are off those beside them, sensor units, by row;
 *   they count as not read.
 * @property isGuessed whether the truth in each row was guessed from those beside it, length n; null where none was.
 * @param like the same log with another reference or other readings, whose times, places and conditions need no second
 *   look; null for none.
 * @throws IllegalArgumentException if lengths differ, times do not ascend or a number is not finite.
 */
public class MeasuredSeries private constructor(
    internal val times: DoubleArray,
    internal val x: DoubleArray,
    internal val y: DoubleArray,
    internal val values: DoubleArray,
    internal val reference: DoubleArray?,
    internal val conditions: Map<String, DoubleArray>,
    internal val isSparse: Boolean,
    internal val isRead: BooleanArray?,
    internal val wild: Map<Int, Double>,
    internal val isGuessed: BooleanArray?,
    like: MeasuredSeries?,
) {
    public constructor(
        times: DoubleArray,
        x: DoubleArray,
        y: DoubleArray,
        values: DoubleArray,
        reference: DoubleArray?,
        conditions: Map<String, DoubleArray> = emptyMap(),
        isSparse: Boolean = false,
        isRead: BooleanArray? = null,
        wild: Map<Int, Double> = emptyMap(),
        isGuessed: BooleanArray? = null,
    ) : this(times, x, y, values, reference, conditions, isSparse, isRead, wild, isGuessed, null)

    init {
        if (like == null) checkRows()
        for ((name, column) in listOfNotNull("values" to values, reference?.let { "reference" to it })) {
            checkColumn(name, column)
        }
        require(isRead == null || isRead.size == times.size) { "isRead must be as long as times (${times.size})" }
    }

    private fun checkRows() {
        checkColumn("x", x)
        checkColumn("y", y)
        for ((name, column) in conditions) checkLength(name, column)
        require(times.all { it.isFinite() }) { "times must be finite" }
        for (i in 1 until times.size) {
            require(times[i] > times[i - 1]) { "times[$i] (${times[i]} s) must be after ${times[i - 1]} s" }
        }
    }

    private fun checkColumn(name: String, column: DoubleArray) {
        checkLength(name, column)
        require(column.all { it.isFinite() }) { "$name must be finite" }
    }

    private fun checkLength(name: String, column: DoubleArray) = require(column.size == times.size) {
        "$name (${column.size} rows) must be as long as times (${times.size})"
    }

    /** Number of rows. */
    public val size: Int get() = times.size

    /** What places are in, in words: along a line, as a profile of pressures, they may be in any unit. */
    internal val placeUnit: String
        get() = if (y.isNotEmpty() && y.all { it == y[0] }) "units of the position" else "m"

    /** From the first row to the last, s. */
    internal val duration: Double = if (times.size < 2) 0.0 else times.last() - times.first()

    /** Median time between rows, s; 1 where there are fewer than two. */
    internal val period: Double = like?.period ?: period(times)

    /** A longer step than this is a gap, over which the sensor is taken to have settled, s. */
    internal val gap: Double = gap(period)

    private val ticks: Lazy<DoubleArray?> = like?.ticks ?: lazy {
        val steps = DoubleArray(times.size) { if (it == 0) 1.0 else (times[it] - times[it - 1]) / period }
        val whole = DoubleArray(times.size) { maxOf(Math.rint(steps[it]), 1.0) }
        val isTicking = steps.indices.count { abs(steps[it] - whole[it]) < OFF_TICK } >= TICKING * times.size
        whole.takeIf { isTicking && whole.any { it > 1 } }
    }

    /**
     * How many usual steps the one before row [i] is long, 1 at least: more where rows are missing between clock ticks; 1
     * where steps are uneven.
     */
    internal fun ticks(i: Int): Double = ticks.value?.get(i) ?: 1.0

    /** Speed of each row, m/s: the condition of that name, or from the positions over some seconds. */
    public val speed: DoubleArray = like?.speed ?: filled(Conditions.SPEED) ?: fromPositions()

    /** Whether the log has places, which are not all one. */
    internal val hasPlaces: Boolean get() = !isFlat(x) || !isFlat(y)

    /** Whether the boat moves, so that there is a way to speak of. */
    internal val isMoving: Boolean get() = median(speed) > SLOWEST

    /** Temperature of each row, °C, or null where there is no such condition. */
    internal val temperature: DoubleArray? =
        if (like != null) like.temperature else filled(Conditions.TEMPERATURE)

    /**
     * Heading of each row, rad: the condition of that name, by its own custom, or the way the positions go over some
     * rows, counter-clockwise from east.
     */
    public val heading: DoubleArray get() = headings.value
    private val headings: Lazy<DoubleArray> = like?.headings ?: lazy {
        filled(Conditions.HEADING) ?: DoubleArray(times.size) { i ->
            val from = maxOf(i - HEADING_ROWS, 0)
            val to = minOf(i + HEADING_ROWS, times.size - 1)
            atan2(y[to] - y[from], x[to] - x[from])
        }
    }

    private fun fromPositions() = DoubleArray(times.size) { i ->
        var from = i
        var to = i
        while (from > 0 && times[i] - times[from] < SPEED_SECONDS) from--
        while (to < times.size - 1 && times[to] - times[i] < SPEED_SECONDS) to++
        val span = times[to] - times[from]
        if (span > 0) hypot(x[to] - x[from], y[to] - y[from]) / span else 0.0
    }

    /** The condition called [name] with its gaps bridged in time; null where there is no such condition. */
    internal fun filled(name: String): DoubleArray? =
        conditions[name]?.let { ConditionGaps(times, it, isCircular = name == Conditions.HEADING).bridged }

    /** How fast [column] rises from the row before row [from] to that after row [to], its units a second. */
    internal fun rise(column: DoubleArray, from: Int, to: Int): Double {
        val before = maxOf(from - 1, 0)
        val after = minOf(to + 1, times.size - 1)
        return (column[after] - column[before]) / (times[after] - times[before])
    }

    /** The rows whose readings are known, as those to be used. */
    internal fun readRows(): BooleanArray = isRead?.copyOf() ?: BooleanArray(size) { true }

    /** [column] in the rows whose readings are known alone; itself where that is all. */
    public fun shown(column: DoubleArray): DoubleArray {
        val known = isRead ?: return column
        return column.filterIndexed { i, _ -> known[i] }.toDoubleArray()
    }

    /** This log without single numbers that are far beyond all others; itself where there are none. */
    internal fun withoutWild(): MeasuredSeries {
        val truth = reference ?: return this
        val unread = readRows()
        val rows = unread.indices.filter { unread[it] }
        val off = WildNumbers.of(shown(values)).map { rows[it] }
        val wrong = WildNumbers.of(truth)
        if (off.isEmpty() && wrong.isEmpty()) return this
        val bridged = WildNumbers.bridged(values, off)
        off.forEach { unread[it] = false }
        return MeasuredSeries(
            times,
            x,
            y,
            bridged,
            WildNumbers.bridged(truth, wrong),
            conditions,
            isSparse,
            if (off.isEmpty()) isRead else unread,
            off.associateWith { values[it] - bridged[it] },
            isGuessed,
        )
    }

    /** This log with the truth bridged in the rows where its reference [failed], whose readings count no more. */
    internal fun withoutFailed(failed: List<Int>): MeasuredSeries {
        if (failed.isEmpty()) return this
        val truth = checkNotNull(reference) { "a log without a reference has none that failed" }.copyOf()
        val unread = readRows()
        val guessed = isGuessed?.copyOf() ?: BooleanArray(size)
        for (row in failed) {
            unread[row] = false
            guessed[row] = true
        }
        val known = DoubleArray(size) { if (guessed[it]) Double.NaN else truth[it] }
        val bridged = ConditionGaps(times, known).bridged
        for (row in failed) truth[row] = bridged[row]
        return MeasuredSeries(times, x, y, values, truth, conditions, isSparse, unread, wild, guessed)
    }

    /** This log with its reference as it was written; itself where nothing was taken off that. */
    internal var written: MeasuredSeries = this
        private set

    /** This log with the same [reference] but for its noise. */
    internal fun withQuieter(reference: DoubleArray) =
        MeasuredSeries(times, x, y, values, reference, conditions, isSparse, isRead, wild, isGuessed, this)
            .also { it.written = written }

    /** This log with [reference] as what is known of the truth. */
    internal fun withReference(reference: DoubleArray) =
        MeasuredSeries(times, x, y, values, reference, conditions, false, null, emptyMap(), null, this)

    /** The same log with other readings. */
    internal fun withReadings(values: DoubleArray) =
        MeasuredSeries(times, x, y, values, reference, conditions, isSparse, isRead, wild, isGuessed, this)

    /**
     * The same log with times from the first row on, to the microsecond: where time is counted from must not change an
     * answer, and does by how finely a time since 1970 is kept, a quarter of a microsecond.
     */
    internal fun fromStart(): MeasuredSeries {
        val since = DoubleArray(size) { Math.rint((times[it] - times[0]) * TICKS_A_SECOND) / TICKS_A_SECOND }
        val isAscending = (1 until size).all { since[it] > since[it - 1] }
        if (!isAscending || since.contentEquals(times)) return this
        return MeasuredSeries(since, x, y, values, reference, conditions, isSparse, isRead, wild, isGuessed)
    }

    /** The same log with each row where the boat was [delay] s before, or at first; on a straight line between two rows. */
    internal fun atPlacesBefore(delay: Double): MeasuredSeries {
        fun before(places: DoubleArray) = DoubleArray(size) { i ->
            val time = times[i] - delay
            val at = times.binarySearch(time).let { if (it >= 0) it else -it - 2 }
            val share = if (at >= 0) (time - times[at]) / (times[at + 1] - times[at]) else 0.0
            if (at < 0) places[0] else places[at] + share * (places[at + 1] - places[at])
        }
        return MeasuredSeries(
            times,
            before(x),
            before(y),
            values,
            reference,
            conditions,
            isSparse,
            isRead,
            wild,
            isGuessed,
            this,
        )
    }

    /** The rows of this log from [from] up to, and without, [until]. */
    internal fun part(from: Int, until: Int): MeasuredSeries {
        fun of(column: DoubleArray) = column.copyOfRange(from, until)
        return MeasuredSeries(
            of(times),
            of(x),
            of(y),
            of(values),
            reference?.let(::of),
            conditions.mapValues { (_, column) -> of(column) },
            isSparse,
            isRead?.copyOfRange(from, until),
            wild.filterKeys { it in from until until }.mapKeys { (row, _) -> row - from },
            isGuessed?.copyOfRange(from, until),
        )
    }

    /** The rows of this log at which [column] has a number, with that as reading; no reference, no conditions. */
    internal fun withValues(column: DoubleArray): MeasuredSeries {
        val rows = column.indices.filter { column[it].isFinite() }
        fun of(all: DoubleArray) = DoubleArray(rows.size) { all[rows[it]] }
        return MeasuredSeries(of(times), of(x), of(y), of(column), null)
    }

    public companion object {
        /**
         * A log in which numbers of [values] and [reference] are missing here and there, NaN: what the sensor has seen
         * where its reading is missing is kept, and what the truth was between two rows that are near is guessed.
         */
        public fun ofMissing(
            times: DoubleArray,
            x: DoubleArray,
            y: DoubleArray,
            values: DoubleArray,
            reference: DoubleArray,
            conditions: Map<String, DoubleArray>,
        ): MeasuredSeries {
            val missing = MissingNumbers(times, values, reference)
            fun of(column: DoubleArray) = DoubleArray(missing.rows.size) { column[missing.rows[it]] }
            return MeasuredSeries(
                of(times),
                of(x),
                of(y),
                of(values).also { column -> for (i in column.indices) if (!missing.isRead[i]) column[i] = 0.0 },
                missing.guessed,
                conditions.mapValues { (_, column) -> of(column) },
                isRead = missing.isRead,
                isGuessed = missing.isGuessed,
            )
        }

        /** Median step between [times], s; 1 where there are fewer than two. */
        internal fun period(times: DoubleArray): Double =
            if (times.size < 2) 1.0 else median(DoubleArray(times.size - 1) { times[it + 1] - times[it] })

        /** A longer step than this is a gap where rows are usually [period] apart, s. */
        internal fun gap(period: Double): Double = maxOf(GAP_STEPS * period, GAP_SECONDS)

        private const val TICKS_A_SECOND = 1e6

        /** Of a usual step: nearer to a whole number of them is one. */
        private const val OFF_TICK = 0.1

        /** Share of the steps that are. */
        private const val TICKING = 0.9
        private const val GAP_STEPS = 20
        private const val GAP_SECONDS = 60.0
        private const val SPEED_SECONDS = 2.5
        private const val HEADING_ROWS = 2

        /** Of a boat that moves, m/s. */
        private const val SLOWEST = 0.02
    }
}

/** Whether all of [column] are the same. */
internal fun isFlat(column: DoubleArray): Boolean = column.all { it == column[0] }

/** The middle of [numbers]; NaN of none. Not modified. */
internal fun median(numbers: DoubleArray): Double {
    if (numbers.isEmpty()) return Double.NaN
    val sorted = numbers.sortedArray()
    val middle = sorted.size / 2
    return if (sorted.size % 2 == 1) sorted[middle] else (sorted[middle - 1] + sorted[middle]) / 2
}
