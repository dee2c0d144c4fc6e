package stillwater.mission

import stillwater.model.Grid
import stillwater.model.Position
import stillwater.plan.ClosedCells

/**
 * What becomes of waypoints that a boat does not come to: the cell ahead of it is closed, so that plans and ways lead
 * round it. After [MOST_ON_END] of them on end it has to show whether the boat, too, is held: it goes back to where it
 * was, and where it does not come there either, or was nowhere else, it [isHeld]. Confined to one thread.
 *
 * @param closed cells. Retained.
 * @param apart places farther apart than this are not the same, m.
 */
internal class HoldUps(private val closed: ClosedCells, private val apart: Double) {
    private val places = ArrayDeque<Position>()
    private var onEnd = 0
    private var blindOnEnd = 0
    private var test: Position? = null
    private var heldAt: Position? = null

    /** Waypoints that were given up. */
    var count = 0L
        private set

    /** Whether nothing is reached any more, wherever the boat is sent. */
    var isHeld = false
        private set

    /** The boat is at [here], from where it sets out. */
    fun setOut(here: Position) {
        if (places.isEmpty()) remember(here)
    }

    /** The boat is at [here], where it was sent to [goal]. */
    fun arrived(here: Position, goal: Position) {
        if (closed.offMiddle(goal.x, goal.y) < MIDST) closed.reached(closed.at(goal.x, goal.y))
        remember(here)
        test = null
        // One that is where it was has not moved.
        if (heldAt?.let { it.distanceTo(here) > apart } != false) {
            heldAt = null
            onEnd = 0
            blindOnEnd = 0
        }
    }

    /**
     * The boat at [here] does not come to [goal], [now] in s. Answers where to go now; null for what the planner says.
     */
    fun giveUp(now: Double, here: Position, goal: Position): Position? {
        count++
        if (heldAt == null) heldAt = here
        // Where something else came in between, the boat has not been on its way back.
        isHeld = goal == test
        test = null
        if (isHeld) return null
        val cell = closed.ahead(here.x, here.y, goal.x, goal.y)
        if (cell == Grid.OUTSIDE || closed.isClosed(cell)) blindOnEnd++ else closed.close(cell, now)
        onEnd++
        if (onEnd < MOST_ON_END) return null
        onEnd = 0
        val back = places.lastOrNull { it.distanceTo(here) > apart }
        // Where no cell can be closed, as off the map, the planner would say the same for ever.
        isHeld = back == null || blindOnEnd >= MOST_ON_END
        test = back.takeIf { !isHeld }
        return test
    }

    private fun remember(here: Position) {
        if (places.isEmpty() || places.last().distanceTo(here) > apart) places.addLast(here)
        if (places.size > PLACES) places.removeFirst()
    }

    private companion object {
        /** Waypoints given up on end after which the boat itself may be held. */
        const val MOST_ON_END = 3

        /** Places kept to go back to. */
        const val PLACES = 3

        /** About the middle of a cell, in cells. */
        const val MIDST = 0.25
    }
}
