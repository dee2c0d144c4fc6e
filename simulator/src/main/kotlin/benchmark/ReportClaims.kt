package stillwater.benchmark

import stillwater.run.Curve
import stillwater.run.ExperimentResult
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import java.util.Locale
import kotlin.math.abs

/**
 * Whether an experiment bears a claim out.
 *
 * @property label the word for it.
 */
enum class Verdict(val label: String) {
    /** It does, by more than two standard errors where curves are compared. */
    HOLDS("holds"),

    /** It speaks against it. */
    FAILS("fails"),

    /** Curves are too close, or the trials too short, to tell. */
    UNDECIDED("cannot be told"),
}

/**
 * One of the report's claims, held against an experiment.
 *
 * @property text the claim, with the field it is about.
 * @property verdict whether the experiment bears it out.
 * @property detail the moves at which it holds, or what was found instead.
 */
data class Claim(val text: String, val verdict: Verdict, val detail: String)

/**
 * The four claims of the report's section 7, held against an experiment at its checkpoints.
 *
 * One curve is below another where the mean difference over the environments, which they share, exceeds two standard
 * errors. A claim needs the curves it speaks of; one whose curves were not run is left out.
 *
 * @param result the experiment.
 */
class ReportClaims(private val result: ExperimentResult) {
    private val last = result.settings.checkpoints.last()
    private val cells = result.settings.grid.size
    private val fields = result.settings.fields.keys

    /** The claims in the report's order, for every field that was run. */
    fun all(): List<Claim> = fields.mapNotNull { walkWinsInTheEnd(it) } +
        fields.mapNotNull { lawnmowerStartsWellAndStops(it) } +
        fields.mapNotNull { plannerWinsForAWhile(it) } +
        listOfNotNull(averagingSuffersMoreInUniform())

    /** "In both cases, random movement with the bounded filter eventually leads to the lowest error." */
    private fun walkWinsInTheEnd(field: String): Claim? {
        val walk = curve(field, PlannerKind.RANDOM_WALK) ?: return null
        // The report has one boat, and more of them are lower for another reason.
        val others = result.curves.filter { it.field == field && it !== walk && it.boats == walk.boats }
        if (others.isEmpty()) return null
        val rival = others.minBy { it.at(last).mean }
        val difference = walk.excessOver(rival, last)
        val rivalText = "${rival.planner.label} with ${rival.filter.label} at move $last: " +
            "${error(rival.at(last).mean)} against ${error(walk.at(last).mean)}"
        val text = "$field: random walk with the bounded filter is eventually lowest"
        return when {
            others.all { walk.excessOver(it, last).clearlyNegative } -> {
                val since = walk.checkpoints.takeLastWhile { move -> others.all { isBelow(walk, it, move) } }
                Claim(text, Verdict.HOLDS, "lowest from move ${since.first()} on")
            }
            difference.clearlyPositive && last >= LONG * cells -> Claim(text, Verdict.FAILS, "lower is $rivalText")
            difference.clearlyPositive -> Claim(text, Verdict.UNDECIDED, "still lower is $rivalText; run more --moves")
            else -> Claim(text, Verdict.UNDECIDED, "too close to $rivalText; run more --moves or --environments")
        }
    }

    /** "The lawnmower pattern performs well initially [...] with the bounded filter [...] asymptotes". */
    private fun lawnmowerStartsWellAndStops(field: String): Claim? {
        val lawnmower = curve(field, PlannerKind.LAWNMOWER) ?: return null
        val walk = curve(field, PlannerKind.RANDOM_WALK) ?: return null
        val atFirst = listOf(FilterKind.BOUNDED, FilterKind.AVERAGING).mapNotNull { filter ->
            val one = curve(field, PlannerKind.LAWNMOWER, filter) ?: return@mapNotNull null
            val other = curve(field, PlannerKind.RANDOM_WALK, filter) ?: return@mapNotNull null
            filter to one.checkpoints.filter { isBelow(one, other, it) }
        }
        val end = lawnmower.at(last).mean
        val settled = lawnmower.checkpoints.takeLastWhile { abs(lawnmower.at(it).mean - end) <= SETTLED * end }
        val staysAbove = settled.isNotEmpty() && 2 * settled.first() <= last && isBelow(walk, lawnmower, last)
        val detail =
            atFirst.joinToString("; ") { (filter, moves) -> "${filter.label}: below the walk at ${runs(moves)}" } +
                "; bounded: ${error(end)} at move $last" +
                if (settled.size > 1) ", the same within 1 % since move ${settled.first()}" else ""
        val verdict = when {
            staysAbove && atFirst.any { it.second.isNotEmpty() } -> Verdict.HOLDS
            last < LONG * cells -> Verdict.UNDECIDED
            else -> Verdict.FAILS
        }
        return Claim(
            "$field: lawnmower is good at first, then stays above zero with the bounded filter",
            verdict,
            detail,
        )
    }

    /** "The bounded planner surprisingly does not perform better than random walk over the long run". */
    private fun plannerWinsForAWhile(field: String): Claim? {
        val planner = curve(field, PlannerKind.BOUNDED) ?: return null
        val walk = curve(field, PlannerKind.RANDOM_WALK) ?: return null
        val better = planner.checkpoints.filter { isBelow(planner, walk, it) }
        val verdict = when {
            better.isNotEmpty() && last !in better -> Verdict.HOLDS
            last < LONG * cells -> Verdict.UNDECIDED
            else -> Verdict.FAILS
        }
        val text = "$field: bounded planner beats the random walk for a while, not in the long run (bounded filter)"
        val end = "at move $last ${error(planner.at(last).mean)} against ${error(walk.at(last).mean)}"
        return Claim(text, verdict, "below the walk at ${runs(better)}; $end")
    }

    /** "The difference is dramatically higher in the random environment". */
    private fun averagingSuffersMoreInUniform(): Claim? {
        val uniform = averagingRatio(Preset.UNIFORM) ?: return null
        val gaussian = averagingRatio(Preset.GAUSSIAN) ?: return null
        val detail = "averaging has %.1f times the bounded filter's error in the uniform field, %.1f times in the " +
            "Gaussian, at move $last"
        return Claim(
            "averaging suffers more from the lag where cells are independent (random walk)",
            if (uniform > gaussian) Verdict.HOLDS else Verdict.FAILS,
            detail.format(Locale.ROOT, uniform, gaussian),
        )
    }

    private fun averagingRatio(field: String): Double? {
        val averaging = curve(field, PlannerKind.RANDOM_WALK, FilterKind.AVERAGING) ?: return null
        val bounded = curve(field, PlannerKind.RANDOM_WALK) ?: return null
        return (averaging.at(last).mean / bounded.at(last).mean).takeIf { it.isFinite() }
    }

    private fun curve(field: String, planner: PlannerKind, filter: FilterKind = FilterKind.BOUNDED): Curve? =
        result.curve(field, planner, filter)

    private fun isBelow(low: Curve, high: Curve, move: Int) = low.excessOver(high, move).clearlyNegative

    private fun error(value: Double) = "%.4f".format(Locale.ROOT, value)

    /** The checkpoints [moves] as runs without a gap, such as "moves 5 to 20, 90 to 120". */
    private fun runs(moves: List<Int>): String {
        if (moves.isEmpty()) return "no checkpoint"
        val runs = ArrayList<MutableList<Int>>()
        for (move in moves) {
            val places = result.settings.checkpoints
            val follows = runs.isNotEmpty() && places.indexOf(move) == places.indexOf(runs.last().last()) + 1
            if (follows) runs.last() += move else runs += mutableListOf(move)
        }
        return "moves " +
            runs.joinToString(", ") { if (it.size == 1) "${it.first()}" else "${it.first()} to ${it.last()}" }
    }

    private companion object {
        /** Trials of so many moves a cell count as the long run: half of what the report's figures have. */
        const val LONG = 10

        /** Share of the error by which a curve may still move and count as settled. */
        const val SETTLED = 0.01
    }
}
