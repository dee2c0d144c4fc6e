package stillwater.io

import stillwater.model.LocalFrame
import stillwater.model.Position
import java.util.Locale

/**
 * The columns that let a place of a log be found again on any map: none where the log's own places are in metres.
 *
 * @param frame frame of the log's places, or null.
 */
internal class GlobeColumns(private val frame: LocalFrame?) {
    /** Names of the columns, as logs are read with. */
    val names: List<String> = if (frame == null) emptyList() else listOf(CsvColumns.LATITUDE, CsvColumns.LONGITUDE)

    /** Latitude and longitude of [x], [y], degrees, to a millimetre; as many as [names]. */
    fun cells(x: Double, y: Double): List<String> {
        val place = (frame ?: return emptyList()).toLatLon(Position(x, y))
        return listOf(place.latitudeDeg, place.longitudeDeg).map { String.format(Locale.ROOT, "%.8f", it) }
    }
}
