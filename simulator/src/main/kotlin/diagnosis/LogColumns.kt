package stillwater.diagnosis

import stillwater.diagnose.MeasuredSeries
import stillwater.model.Conditions

/** The columns of a log as they grow: times, s; positions, m; readings; [conditions] by name. */
class LogColumns(private val conditions: Collection<String>) {
    private val rows = ArrayList<DoubleArray>()
    private val names = conditions.toList()

    /** Number of rows. */
    val size: Int get() = rows.size

    /** Takes a row. */
    fun add(time: Double, x: Double, y: Double, value: Double, others: Conditions) {
        val row = DoubleArray(FIXED + 1 + names.size)
        row[0] = time
        row[1] = x
        row[2] = y
        row[3] = value
        row[FIXED] = others[DiagnosisLog.REFERENCE]
        names.forEachIndexed { i, name -> row[FIXED + 1 + i] = others[name] }
        rows += row
    }

    /** These columns without the rows that are [leftOut]. */
    internal fun without(leftOut: BooleanArray): LogColumns {
        val kept = LogColumns(conditions)
        rows.filterIndexedTo(kept.rows) { i, _ -> !leftOut[i] }
        return kept
    }

    /** Takes the readings at [times], s, for not known; before any column is taken. */
    internal fun unread(times: Set<Double>) {
        for (row in rows) if (row[0] in times) row[3] = Double.NaN
    }

    /** Takes the truth at [times], s, for not known; before any column is taken. */
    internal fun untold(times: Set<Double>) {
        for (row in rows) if (row[0] in times) row[FIXED] = Double.NaN
    }

    private fun column(i: Int) = DoubleArray(rows.size) { rows[it][i] }

    /** Makes radians of the degrees of the condition [name]; before any column is taken. */
    internal fun toRadians(name: String) {
        val column = FIXED + 1 + names.indexOf(name)
        for (row in rows) row[column] = Math.toRadians(row[column])
    }

    /** Times, s. */
    val times: DoubleArray by lazy { column(0) }

    /** Metres east. */
    val x: DoubleArray by lazy { column(1) }

    /** Metres north. */
    val y: DoubleArray by lazy { column(2) }

    /** Readings, sensor units. */
    val values: DoubleArray by lazy { column(3) }

    /** Truth up to noise, sensor units; NaN where there is none. */
    val reference: DoubleArray by lazy { column(FIXED) }

    /** The condition called [name], or null where there is none. */
    fun condition(name: String): DoubleArray? =
        names.indexOf(name).takeIf { it >= 0 }?.let { column(FIXED + 1 + it) }

    /**
     * The columns as a diagnosis takes them, of the [conditions] alone; [isSparse] where rows between them have no
     * reference.
     */
    fun series(withReference: Boolean, isSparse: Boolean, conditions: Collection<String> = names) = MeasuredSeries(
        times,
        x,
        y,
        values,
        if (withReference) reference else null,
        conditions.associateWith { checkNotNull(condition(it)) },
        isSparse,
    )

    /** The same of these columns where readings and references that are not known are NaN. */
    fun missing(conditions: Collection<String>) = MeasuredSeries.ofMissing(
        times,
        x,
        y,
        values,
        reference,
        conditions.associateWith { checkNotNull(condition(it)) },
    )

    private companion object {
        const val FIXED = 4
    }
}
