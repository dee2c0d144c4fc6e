package stillwater.closedloop

import stillwater.model.WaterArea
import stillwater.virtual.VirtualBoat

/**
 * Sees what no mission can: where the boat truly is, what its motors truly get, and whether the link truly works.
 *
 * @param area the water, for a fence of its own.
 * @param margin how far beyond the fence motors may run, m.
 * @param longest time that motors may go on when the link is lost, s.
 */
internal class Observer(
    private val boat: VirtualBoat,
    private val area: WaterArea,
    private val margin: Double,
    private val longest: Double,
) {
    private var lostSince = Double.NaN
    private var ranWithoutLink = 0.0
    private var isTooLong = false
    private var wasBeyond = false

    /** Losses of the link after which motors went on too long. */
    var tooLong = 0
        private set

    /** Longest time that motors went on, s. */
    var worstTimeToZero = 0.0
        private set

    /** Times the motors ran beyond the margin. */
    var beyondMargin = 0
        private set

    /** Farthest beyond the fence with motors running and with motors at rest, m. */
    var worstDriven = 0.0
        private set
    var worstDrifted = 0.0
        private set

    /** Time under power, s. */
    var underPower = 0.0
        private set

    /** Looks, [dt] s after the last time; [linked] is whether both ways work and somebody is at the other end. */
    fun look(dt: Double, linked: Boolean) {
        val now = boat.time.seconds
        val runs = !boat.board.actuation.isAtRest
        if (runs) underPower += dt
        watchLink(now, runs, linked)
        watchFence(runs)
    }

    private fun watchLink(now: Double, runs: Boolean, linked: Boolean) {
        if (linked) {
            lostSince = Double.NaN
            isTooLong = false
            return
        }
        // Lost since the tick before, at which it still worked.
        if (lostSince.isNaN()) lostSince = now - VirtualBoat.TICK
        if (!runs) return
        ranWithoutLink = now - lostSince
        worstTimeToZero = maxOf(worstTimeToZero, ranWithoutLink)
        if (ranWithoutLink > longest && !isTooLong) {
            isTooLong = true
            tooLong++
        }
    }

    private fun watchFence(runs: Boolean) {
        val x = boat.dynamics.x
        val y = boat.dynamics.y
        val out = if (area.contains(x, y)) 0.0 else area.distanceToOutline(x, y)
        if (runs) worstDriven = maxOf(worstDriven, out) else worstDrifted = maxOf(worstDrifted, out)
        val isBeyond = runs && out > margin
        if (isBeyond && !wasBeyond) beyondMargin++
        wasBeyond = isBeyond
    }
}
