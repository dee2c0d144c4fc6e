package stillwater.diagnose.reference

import stillwater.diagnose.MeasuredSeries

/**
 * The reference of [series] with which a model whose truth is held over each step holds a [share] of the row before, but
 * where that is a gap away ([isGap]); where rows are missing between, the mean of what was held there. Length n.
 */
internal fun rowBefore(series: MeasuredSeries, isGap: BooleanArray, share: Double): DoubleArray {
    val reference = requireNotNull(series.reference) { "the row before needs a reference" }
    val out = reference.copyOf()
    for (i in 1 until series.size) {
        if (isGap[i]) continue
        val ticks = series.ticks(i)
        val held = reference[i] + (share + (ticks - 1) / 2) / ticks * (reference[i - 1] - reference[i])
        // Of such a step the model takes the rows between for on the way: the row's own share is but this.
        val own = (ticks + 1) / (2 * ticks)
        out[i] = (held - (1 - own) * out[i - 1]) / own
    }
    return out
}
