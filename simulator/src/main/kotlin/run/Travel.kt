package stillwater.run

/**
 * How boats move and sample in a trial.
 *
 * @property samplesPerMove readings in a move, at least 1.
 * @property period time between readings, s, above 0.
 * @property speed how fast a boat goes along its waypoints, m/s, above 0, taking its samples on the way; null where it
 *   goes from cell to cell instead: to one waypoint a move, however far, where it takes all of the move's samples.
 * @throws IllegalArgumentException if a number is out of its range.
 */
data class Travel(val samplesPerMove: Int, val period: Double, val speed: Double? = null) {
    init {
        require(samplesPerMove >= 1) { "samplesPerMove ($samplesPerMove) must be at least 1" }
        require(period > 0 && period.isFinite()) { "period ($period s) must be above 0 and finite" }
        require(speed == null || (speed > 0 && speed.isFinite())) { "speed ($speed m/s) must be above 0 and finite" }
    }
}

/** What a boat has spent so far. */
class Odometer {
    /** Moves made; the stay at the start is the first. In a continuous voyage parts of a move count too. */
    var moves: Double = 0.0
        internal set

    /** Way made good along the waypoints, m. */
    var metres: Double = 0.0
        internal set

    /** Time since the start, s. */
    var seconds: Double = 0.0
        internal set
}
