package stillwater.run

import stillwater.field.CellField
import stillwater.field.FieldMap
import kotlin.math.abs

/**
 * Judges maps against the truth.
 *
 * @property extremes for each cell whether it is a local extreme of the field. Not modified.
 * @param water for each cell whether it counts; null for all. Not modified.
 */
class MapScore(private val extremes: BooleanArray, water: BooleanArray? = null) {
    private val cells = extremes.indices.filter { water == null || water[it] }.toIntArray()

    /** Writes what [map] is worth in [field] into [errors] at [checkpoint]. */
    fun take(map: FieldMap, field: CellField, errors: TrialErrors, checkpoint: Int) {
        val rounding = ROUNDING * map.prior.width
        var all = 0.0
        var inExtremes = 0.0
        var visited = 0
        var covered = 0
        var width = 0.0
        for (cell in cells) {
            val truth = field.truth(cell)
            val error = abs(map.value(cell) - truth)
            all += error
            if (extremes[cell]) inExtremes += error
            if (map.readings(cell) == 0) continue
            visited++
            if (truth >= map.lower(cell) - rounding && truth <= map.upper(cell) + rounding) covered++
            width += map.upper(cell) - map.lower(cell)
        }
        errors.mean[checkpoint] = all / cells.size
        errors.inExtremes[checkpoint] = inExtremes / cells.size
        errors.coverage[checkpoint] = covered.toDouble() / visited
        errors.width[checkpoint] = width / visited
    }

    private companion object {
        /** What a bound may miss the truth by for the numbers' own rounding, in widths of the prior. */
        const val ROUNDING = 1e-12
    }
}
