package stillwater.mission

import stillwater.model.Position

/**
 * Where a boat did not get in, and did not come to later.
 *
 * @property cells of the map.
 * @property offMap middles of such cells about the map, as large as the map's, m.
 */
public data class GivenUp(val cells: List<Int> = emptyList(), val offMap: List<Position> = emptyList())
