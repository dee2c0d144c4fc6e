package stillwater.app.setup

import android.content.Context
import stillwater.app.R
import stillwater.control.Danger
import stillwater.mission.DraftCheck
import stillwater.mission.DraftField
import stillwater.mission.EstimatorName
import stillwater.mission.FailsafeSpec
import stillwater.mission.MissionDraft
import stillwater.mission.PlannerName
import stillwater.mission.Quantity

/** What a person calls it. */
internal fun Quantity.words(): Int =
    when (this) {
        Quantity.DISSOLVED_OXYGEN -> R.string.quantity_oxygen
        Quantity.ACIDITY -> R.string.quantity_acidity
        Quantity.CONDUCTIVITY -> R.string.quantity_conductivity
        Quantity.TEMPERATURE -> R.string.quantity_temperature
        Quantity.DEPTH -> R.string.quantity_depth
    }

/** What a person calls it. */
internal fun EstimatorName.words(): Int =
    when (this) {
        EstimatorName.AVERAGING -> R.string.estimator_averaging
        EstimatorName.EXPONENTIAL -> R.string.estimator_exponential
        EstimatorName.BOUNDED -> R.string.estimator_bounded
        EstimatorName.INTERVAL -> R.string.estimator_interval
        EstimatorName.SELF_CALIBRATING -> R.string.estimator_self_calibrating
        EstimatorName.BOUNDED_EXTENDED -> R.string.estimator_bounded_extended
        EstimatorName.BAYESIAN -> R.string.estimator_bayesian
    }

/** What a person calls it. */
internal fun PlannerName.words(): Int =
    when (this) {
        PlannerName.RANDOM_WALK -> R.string.planner_random_walk
        PlannerName.LAWNMOWER -> R.string.planner_lawnmower
        PlannerName.BOUNDED -> R.string.planner_bounded
        PlannerName.BOUNDED_EXTENDED -> R.string.planner_bounded_extended
        PlannerName.INFORMATION -> R.string.planner_information
        PlannerName.SETTLING_LAWNMOWER -> R.string.planner_settling
        PlannerName.POLYGON_RRT -> R.string.planner_polygon
    }

/** What a person calls it. */
internal fun FailsafeSpec.words(): Int =
    when (this) {
        FailsafeSpec.HOLD -> R.string.failsafe_hold
        FailsafeSpec.RETURN_HOME -> R.string.failsafe_return
        FailsafeSpec.STOP -> R.string.failsafe_stop
    }

/** What is in the way, in words. */
internal fun Danger.words(): Int =
    when (this) {
        Danger.OPERATOR_STOP -> R.string.danger_stop
        Danger.LINK_LOST -> R.string.danger_link
        Danger.FIX_STALE -> R.string.danger_fix_stale
        Danger.FIX_JUMPING -> R.string.danger_fix_jumping
        Danger.BATTERY_LOW -> R.string.danger_battery
        Danger.STRANDED -> R.string.danger_stranded
        Danger.HELD_UP -> R.string.danger_held_up
        Danger.PHONE_LOW -> R.string.danger_phone
        Danger.FENCE -> R.string.danger_fence
        Danger.LOG_LOST -> R.string.danger_log
        Danger.OPERATOR_WAIT -> R.string.danger_wait
        Danger.OPERATOR_HOLD -> R.string.danger_hold
        Danger.OPERATOR_RETURN -> R.string.danger_return
        Danger.BUDGET_SPENT -> R.string.danger_budget
        Danger.MISSION_END -> R.string.danger_end
    }

/** What a form calls a number; its unit comes behind. */
internal fun DraftField.words(): Int =
    when (this) {
        DraftField.NAME -> R.string.field_name
        DraftField.AREA -> R.string.field_area
        DraftField.HOME -> R.string.field_home
        DraftField.CELL -> R.string.field_cell
        DraftField.PORT -> R.string.field_port
        DraftField.LOWEST -> R.string.field_lowest
        DraftField.HIGHEST -> R.string.field_highest
        DraftField.LARGEST_JUMP -> R.string.field_jump
        DraftField.STUCK_AFTER -> R.string.field_stuck
        DraftField.SMALLEST_SLOPE -> R.string.field_slope
        DraftField.READING_ERROR -> R.string.field_error
        DraftField.LATENCY -> R.string.field_latency
        DraftField.SLOWEST -> R.string.field_slowest
        DraftField.PLANNER -> R.string.field_planner
        DraftField.BUDGET -> R.string.field_budget
        DraftField.RESERVE -> R.string.field_reserve
        DraftField.TOP_SPEED -> R.string.field_top_speed
        DraftField.CRUISE -> R.string.field_cruise
        DraftField.ARRIVAL -> R.string.field_arrival
        DraftField.LOWEST_VOLTS -> R.string.field_volts
        DraftField.LOWEST_PHONE -> R.string.field_phone
    }

/** How much has been drawn, in a line. */
internal fun Context.areaSummary(draft: MissionDraft, check: DraftCheck): String {
    val corners = resources.getQuantityString(R.plurals.corners, draft.shore.size, draft.shore.size)
    val out = draft.keepOuts.size
    val parts =
        listOfNotNull(
            corners.takeIf { draft.shore.isNotEmpty() },
            resources.getQuantityString(R.plurals.keep_outs, out, out).takeIf { out > 0 },
            getString(R.string.home_is_set).takeIf { draft.home != null },
            check.grid?.let { getString(R.string.cells_of, it.columns, it.rows, draft.text(DraftField.CELL)) },
        )
    return parts.joinToString()
}
