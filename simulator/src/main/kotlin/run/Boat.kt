package stillwater.run

import stillwater.estimate.FieldEstimator
import stillwater.field.CellField
import stillwater.field.FieldMap
import stillwater.model.Conditions
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.StopCondition
import stillwater.sensor.SensorModel
import kotlin.math.abs
import kotlin.math.hypot

/**
 * One boat of a trial: it goes where its planner says and several estimators read its sensor.
 *
 * @param start where it begins.
 * @property sensor the boat's sensor, settled at the start's truth.
 * @property planner where to go.
 * @property estimators each gets every reading of this boat.
 * @property travel how it moves and samples.
 * @property odometer counts what it spends. Modified.
 * @property tellsSpeed whether [sensor] is told how fast the boat goes, m/s: from cell to cell the way of a move in the
 *   move's time, and 0 where it stays. Nothing else is told.
 */
class Boat(
    start: Position,
    private val sensor: SensorModel,
    private val planner: Planner,
    val estimators: List<FieldEstimator>,
    private val travel: Travel,
    val odometer: Odometer = Odometer(),
    private val tellsSpeed: Boolean = false,
) {
    private val plan = Plan()
    private var waypoint = 0
    private var samples = 0L
    private var reading = 0.0
    private var speed = 0.0
    private var conditions = speedOf(0.0)
    private val times = DoubleArray(travel.samplesPerMove)
    private val readings = DoubleArray(travel.samplesPerMove)

    /** Where it is, local frame, m. */
    var x: Double = start.x
        private set

    /** Where it is, local frame, m. */
    var y: Double = start.y
        private set

    /** Whether its budget is spent; it neither moves nor samples any more. */
    var isDone: Boolean = false
        private set

    /** Called with every place a sample is taken at; null where nobody wants to know. */
    var onSample: ((Double, Double) -> Unit)? = null

    /**
     * Makes a move: from the second on, to the next waypoint or along the waypoints; then or meanwhile, samples.
     *
     * @param field the truth.
     * @param map what the planner plans on, asked for only where it is about to plan.
     */
    fun move(field: CellField, map: () -> FieldMap) {
        val isFirst = samples == 0L
        if (travel.speed == null) {
            if (!isFirst) step(map)
            if (isDone) return
            sample(field, travel.samplesPerMove)
            odometer.moves++
            return
        }
        repeat(travel.samplesPerMove) {
            if (!isFirst) sail(travel.speed * travel.period, map)
            if (isDone) return
            sample(field, 1)
            odometer.moves = samples.toDouble() / travel.samplesPerMove
        }
    }

    /** To the next waypoint at once. */
    private fun step(map: () -> FieldMap) {
        if (waypoint == plan.size) ask(map)
        var way = 0.0
        if (waypoint < plan.size) {
            way = distance(plan.x(waypoint) - x, plan.y(waypoint) - y)
            odometer.metres += way
            x = plan.x(waypoint)
            y = plan.y(waypoint)
            waypoint++
        }
        goes(way / (travel.samplesPerMove * travel.period))
    }

    /** √(east² + north²), m; a way along an axis, as nearly all are, needs no root. */
    private fun distance(east: Double, north: Double): Double = when {
        east == 0.0 -> abs(north)
        north == 0.0 -> abs(east)
        else -> hypot(east, north)
    }

    /** On by [distance] m along the waypoints; it waits at the last one for the time that is left. */
    private fun sail(distance: Double, map: () -> FieldMap) {
        if (waypoint == plan.size) ask(map)
        var left = distance
        while (left > 0 && waypoint < plan.size) {
            val leg = hypot(plan.x(waypoint) - x, plan.y(waypoint) - y)
            if (leg <= left) {
                x = plan.x(waypoint)
                y = plan.y(waypoint)
                waypoint++
            } else {
                x += left / leg * (plan.x(waypoint) - x)
                y += left / leg * (plan.y(waypoint) - y)
            }
            odometer.metres += minOf(leg, left)
            left -= leg
        }
        goes((if (left > 0) distance - left else distance) / travel.period)
    }

    /** It goes at [now] m/s; only where that is new, and the sensor is told, something is made anew. */
    private fun goes(now: Double) {
        if (!tellsSpeed || now == speed) return
        speed = now
        conditions = speedOf(now)
    }

    private fun speedOf(now: Double) = if (tellsSpeed) Conditions(mapOf(Conditions.SPEED to now)) else Conditions.NONE

    private fun ask(map: () -> FieldMap) {
        val outcome = planner.plan(map(), Position(x, y), reading, StopCondition.NEVER, plan)
        check(outcome == PlanOutcome.Planned || plan.size == 0) { "$outcome with ${plan.size} waypoints" }
        waypoint = 0
        isDone = outcome == PlanOutcome.BudgetSpent
    }

    /** Takes [count] samples where the boat is, then hands them to each estimator. */
    private fun sample(field: CellField, count: Int) {
        val truth = field.truth(x, y)
        for (i in 0 until count) times[i] = ++samples * travel.period
        sensor.stepAll(truth, travel.period, conditions, readings, count)
        onSample?.let { told -> repeat(count) { told(x, y) } }
        reading = readings[count - 1]
        odometer.seconds = times[count - 1]
        for (estimator in estimators) estimator.updateAll(times, x, y, readings, count)
    }
}
