package stillwater.estimate

/**
 * Where a reading was taken, and how well that is known. One object for all readings in turn.
 *
 * @property width size of a cell along the grid's first axis, m. @property height along its second one, m.
 */
internal class Place(val width: Double = 1.0, val height: Double = 1.0) {
    /** Metres from the grid's origin along its first axis. */
    var along: Double = Double.NaN
        private set

    /** Metres from the grid's origin along its second axis. */
    var across: Double = Double.NaN
        private set

    /** Standard deviation along each axis, m; NaN where nothing was said of it. */
    var deviation: Double = Double.NaN
        private set

    /** Whether it is so near to a border that the reading may be of another cell. */
    var isNearBorder: Boolean = false
        private set

    /** Another reading's, of whose place nothing was said. */
    fun forget() = set(Double.NaN, Double.NaN, Double.NaN, isNearBorder = false)

    /** Another reading's. */
    fun set(along: Double, across: Double, deviation: Double, isNearBorder: Boolean) {
        this.along = along
        this.across = across
        this.deviation = deviation
        this.isNearBorder = isNearBorder
    }

    /** Whether anything was said of how well it is known. */
    val isKnown: Boolean get() = deviation >= 0
}
