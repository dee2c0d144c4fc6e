package stillwater.io

import stillwater.model.LatLon
import stillwater.model.LocalFrame
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

    /**
     * The first row with a place that is near those after it, where up to [FarFixes.MOST] rows before it are far from it: a
     * receiver's first fixes may be wild. Null where none is.
     */
    private fun afterWildOnes(): Int? {
        val rows = north.indices.filter(::isPlace).take(FarFixes.MOST + FarFixes.SETTLED)
        val jump = (1..FarFixes.MOST).lastOrNull {
            it < rows.size &&
                metres(rows[it - 1], rows[it]) > FarFixes.FAR_METRES
        }
        val near = rows.drop(jump ?: return null).take(FarFixes.SETTLED)
        val isSettled =
            near.size == FarFixes.SETTLED && near.zipWithNext().all { (a, b) -> metres(a, b) < FarFixes.FAR_METRES }
        return near.firstOrNull()?.takeIf { isSettled }
    }

    companion object {
        /** Where the places in the head of a log in degrees begin after wild ones; null where the first one is none. */
        fun afterWildOnes(layout: CsvLayout, columns: CsvColumns): LocalFrame? {
            val places = of(columns, layout::numbers)?.takeIf { it.inDegrees } ?: return null
            val row = places.afterWildOnes() ?: return null
            val latitude = places.north[row]
            val longitude = places.east[row]
            val isOnGlobe = latitude in LatLon.LATITUDES_DEG && longitude in LatLon.LONGITUDES_DEG
            return if (isOnGlobe && LocalFrame.canStartAt(latitude)) LocalFrame(LatLon(latitude, longitude)) else null
        }

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
