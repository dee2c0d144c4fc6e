package stillwater.io

import kotlin.math.cos
import kotlin.math.hypot

/** Where the rows in the head of a log are, by its columns of places. */
internal class HeadPlaces private constructor(
    private val north: List<Double>,
    private val east: List<Double>,
    private val inDegrees: Boolean,
) {
    /** Whether row [i] has a place. */
    fun isPlace(i: Int): Boolean {
        if (!east[i].isFinite() || !north[i].isFinite() || CellText.isCode(east[i]) || CellText.isCode(north[i])) {
            return false
        }
        return !inDegrees || east[i] != 0.0 || north[i] != 0.0
    }

    /** How far row [b] is from row [a], both with a place, m. */
    fun metres(a: Int, b: Int): Double {
        val up = north[b] - north[a]
        val right = east[b] - east[a]
        return if (inDegrees) METRES_A_DEGREE * hypot(up, right * cos(Math.toRadians(north[a]))) else hypot(up, right)
    }

    companion object {
        private const val METRES_A_DEGREE = 111_195.0

        /** The places of rows whose [numbers] of a column these are; null where [columns] hold none both ways. */
        fun of(columns: CsvColumns, numbers: (Int) -> List<Double>): HeadPlaces? {
            val inDegrees = columns.latitude != CsvColumns.NONE
            if (!inDegrees && columns.y == CsvColumns.NONE) return null
            val east = if (inDegrees) columns.longitude else columns.x
            return HeadPlaces(numbers(if (inDegrees) columns.latitude else columns.y), numbers(east), inDegrees)
        }
    }
}
