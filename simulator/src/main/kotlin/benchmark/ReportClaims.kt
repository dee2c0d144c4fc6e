package stillwater.benchmark

import stillwater.run.Curve
import stillwater.run.ExperimentResult
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import java.util.Locale

/**
 * One of the report's claims, held against an experiment.
 *
 * @property text the claim, with the field it is about.
 * @property holds whether the experiment bears it out.
 * @property detail the moves at which it holds, or what was found instead.
 */
data class Claim(val text: String, val holds: Boolean, val detail: String)

/**
 * The four claims of the report's section 7, held against the mean curves of an experiment at its checkpoints.
 *
 * A claim needs the curves it speaks of; one whose curves were not run is left out.
 *
 * @param result the experiment.
 */
class ReportClaims(private val result: ExperimentResult) {
    private val last = result.settings.checkpoints.last()
    private val fields = result.settings.fields.keys

    /** The claims in the report's order, for every field that was run. */
    fun all(): List<Claim> = fields.mapNotNull { walkWinsInTheEnd(it) } +
        fields.mapNotNull { lawnmowerStartsWellAndStops(it) } +
        fields.mapNotNull { plannerWinsForAWhile(it) } +
        listOfNotNull(averagingSuffersMoreInUniform())

    /** "In both cases, random movement with the bounded filter eventually leads to the lowest error." */
    private fun walkWinsInTheEnd(field: String): Claim? {
        val walk = bounded(field, PlannerKind.RANDOM_WALK) ?: return null
        val others = result.curves.filter { it.field == field && it !== walk }
        if (others.isEmpty()) return null
        val since = walk.checkpoints.takeLastWhile { move -> others.all { walk.at(move).mean < it.at(move).mean } }
        val best = others.minBy { it.at(last).mean }
        val own = walk.at(last).mean
        val other = best.at(last).mean
        val rival = "at move $last ${best.planner.label} with ${best.filter.label}"
        val detail = when {
            since.isNotEmpty() -> "lowest from move ${since.first()} on"
            other < own -> "$rival is lower: ${error(other)} against ${error(own)}"
            other == own -> "$rival is as low: ${error(other)}"
            else -> "not comparable: $rival has ${error(other)}, the walk ${error(own)}"
        }
        return Claim("$field: random walk with the bounded filter is eventually lowest", since.isNotEmpty(), detail)
    }

    /** "The lawnmower pattern performs well initially [...] with the bounded filter [...] asymptotes". */
    private fun lawnmowerStartsWellAndStops(field: String): Claim? {
        val lawnmower = bounded(field, PlannerKind.LAWNMOWER) ?: return null
        val walk = bounded(field, PlannerKind.RANDOM_WALK) ?: return null
        val better = lawnmower.checkpoints.filter { lawnmower.at(it).mean < walk.at(it).mean }
        val final = lawnmower.at(last).mean
        val settled = lawnmower.checkpoints.takeLastWhile { lawnmower.at(it).mean == final }
        val holds = better.isNotEmpty() && settled.size > 1 && final > walk.at(last).mean
        val end = if (settled.size > 1) {
            "constant ${error(final)} from move ${settled.first()} on"
        } else {
            "${error(final)} and not constant at move $last"
        }
        val detail = "below the walk at ${moves(better)}; $end"
        return Claim("$field: lawnmower with the bounded filter is good at first, then stays above zero", holds, detail)
    }

    /** "The bounded planner surprisingly does not perform better than random walk over the long run". */
    private fun plannerWinsForAWhile(field: String): Claim? {
        val planner = bounded(field, PlannerKind.BOUNDED) ?: return null
        val walk = bounded(field, PlannerKind.RANDOM_WALK) ?: return null
        val better = planner.checkpoints.filter { planner.at(it).mean < walk.at(it).mean }
        val holds = better.isNotEmpty() && last !in better
        val text = "$field: bounded planner beats the random walk only for a while (bounded filter)"
        return Claim(text, holds, "below the walk at ${moves(better)}")
    }

    /** "The difference is dramatically higher in the random environment". */
    private fun averagingSuffersMoreInUniform(): Claim? {
        val uniform = averagingRatio(Preset.UNIFORM) ?: return null
        val gaussian = averagingRatio(Preset.GAUSSIAN) ?: return null
        val detail = "averaging is %.1f times worse in the uniform field, %.1f times in the Gaussian, at move $last"
        return Claim(
            "averaging suffers more from the lag where cells are independent (random walk)",
            uniform > gaussian,
            detail.format(Locale.ROOT, uniform, gaussian),
        )
    }

    private fun averagingRatio(field: String): Double? {
        val averaging = result.curve(field, PlannerKind.RANDOM_WALK, FilterKind.AVERAGING) ?: return null
        val bounded = bounded(field, PlannerKind.RANDOM_WALK) ?: return null
        return (averaging.at(last).mean / bounded.at(last).mean).takeIf { it.isFinite() }
    }

    private fun bounded(field: String, planner: PlannerKind): Curve? = result.curve(field, planner, FilterKind.BOUNDED)

    private fun error(value: Double) = "%.4f".format(Locale.ROOT, value)

    private fun moves(moves: List<Int>) = when (moves.size) {
        0 -> "no checkpoint"
        1 -> "move ${moves.single()}"
        else -> "moves ${moves.first()} to ${moves.last()}"
    }
}
