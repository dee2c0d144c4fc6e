package stillwater.app.screen

import stillwater.field.FieldMap
import stillwater.mission.GivenUp
import stillwater.model.Position

/**
 * What the map screen draws; nothing in it changes once it is handed over. Positions in the local frame, m.
 *
 * @property map a copy of what is believed; null before the first.
 * @property track where the boat has been, oldest first.
 * @property plan where it means to go, next first.
 * @property fence corners of the area it may not leave; empty where there is none.
 * @property keepOuts outlines within that are kept out of.
 * @property home where it returns to.
 * @property boat where it is.
 * @property headingDeg where it points, compass degrees; null where unknown.
 * @property unit of the value, for the words; empty where it has none.
 * @property givenUp where the boat did not get in.
 * @property ageOf seconds since the last reading of a cell; null where there was none.
 */
internal class MapScene(
    val map: FieldMap? = null,
    val track: List<Position> = emptyList(),
    val plan: List<Position> = emptyList(),
    val fence: List<Position> = emptyList(),
    val keepOuts: List<List<Position>> = emptyList(),
    val home: Position? = null,
    val boat: Position? = null,
    val headingDeg: Float? = null,
    val unit: String = "",
    val givenUp: GivenUp = GivenUp(),
    val ageOf: (Int) -> Double? = { null },
) {
    /** All that has to fit onto the screen. */
    val extent: List<Position> by lazy(LazyThreadSafetyMode.NONE) {
        val corners =
            map?.grid?.let { grid ->
                listOf(0, grid.columns - 1, grid.size - grid.columns, grid.size - 1).flatMap(grid::corners)
            }
        corners.orEmpty() + track + fence + listOfNotNull(home, boat)
    }
}
