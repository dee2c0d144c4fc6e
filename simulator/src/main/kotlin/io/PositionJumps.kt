package stillwater.io

import stillwater.report.counted
import kotlin.math.hypot

/**
 * Counts the steps from one reading's position to the next's that are too fast for a boat: over more than [FAR] m, at
 * more than [FAST] m/s; on a transect in its own units. They are told, not left out.
 *
 * Confined to one thread. [take] allocates nothing.
 *
 * @param speedUnit what speeds are counted in, for people.
 */
internal class PositionJumps(private val speedUnit: String) {
    private var seconds = Double.NaN
    private var x = Double.NaN
    private var y = Double.NaN
    private var firstLine = 0L

    /** Jumps so far. */
    var count = 0L
        private set

    /** What to say of them; null where there are none. */
    val note: String?
        get() = when (count) {
            0L -> null
            1L -> words("is", "at line $firstLine")
            else -> words("are", "the first at line $firstLine")
        }

    /** Takes the next reading, of [line] of the file, at [seconds] s and ([x], [y]) m. */
    fun take(line: Long, seconds: Double, x: Double, y: Double) {
        val east = x - this.x
        val north = y - this.y
        // Nearly all steps are short, and a square is faster than a root.
        val isJump = east * east + north * north > FAR * FAR && hypot(east, north) > FAST * (seconds - this.seconds)
        if (isJump && count++ == 0L) firstLine = line
        this.seconds = seconds
        this.x = x
        this.y = y
    }

    private fun words(are: String, where: String) =
        "${counted(count, "jump")} in the positions $are faster than ${FAST.toInt()} $speedUnit, $where: check the " +
            "receiver's fixes"

    private companion object {
        const val FAR = 10.0
        const val FAST = 20.0
    }
}
