package stillwater.survey

/**
 * A straight stretch of a track along the survey's main axis.
 *
 * @property first index of its first point in the track.
 * @property last index of its last point in the track.
 * @property forward whether it runs with the axis, not against it.
 * @property start smallest coordinate along the axis, m.
 * @property end largest coordinate along the axis, m.
 * @property across mean coordinate across the axis, m.
 * @property seconds time it took, s.
 */
data class Leg(
    val first: Int,
    val last: Int,
    val forward: Boolean,
    val start: Double,
    val end: Double,
    val across: Double,
    val seconds: Double,
) {
    /** Way along the axis, m. */
    val length: Double get() = end - start

    /** Number of points. */
    val points: Int get() = last - first + 1
}

/**
 * The legs of a survey.
 *
 * @property axis direction of the main axis, rad, counter-clockwise from east, within -pi/2..pi/2.
 * @property legs in the order of time.
 */
class Legs(val axis: Double, val legs: List<Leg>)
