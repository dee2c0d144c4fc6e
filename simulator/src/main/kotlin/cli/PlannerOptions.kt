package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.nullableFlag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.plan.BoundedExtendedPlannerSettings
import stillwater.plan.Execution
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Neighbours
import stillwater.plan.PathChoice
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.Priority
import stillwater.plan.WalkSteps
import stillwater.run.PlannerKind
import stillwater.run.PlannerSettings

/** The options of the planners. */
class PlannerOptions : OptionGroup(name = "Planners") {
    private val walk by option("--walk", metavar = "STEPS", help = "random walk: edge, or diagonal as in the original")
        .oneOf(WALKS)
    private val pattern by option(
        "--pattern",
        "--lawnmower",
        metavar = "NAME",
        help = "lawnmower: ${PATTERNS.keys.joinToString(", ")}",
    ).oneOf(PATTERNS)
    private val horizon by option(
        "--horizon",
        metavar = "N",
        help = "bounded planners and information: moves in the longest path",
    )
        .wholeNumber("a whole number within 1..$LONGEST_HORIZON") { it in 1..LONGEST_HORIZON }
    private val expansions by option(
        "--expansions",
        metavar = "N",
        help = "bounded planners: nodes expanded for a plan",
    )
        .wholeNumber("a whole number within 1..$MOST_EXPANSIONS") { it in 1..MOST_EXPANSIONS }
    private val maxChange by option(
        "--max-change",
        metavar = "VALUE",
        help = "bounded planner: largest change of the sensor expected in one cell",
    ).number("a number above 0") { it > 0 }
    private val discountVisits by option(
        "--discount-visits",
        help = "bounded planner: divide a cell's value by 1 + its visits earlier on the path, or do not",
    ).nullableFlag("--no-discount-visits")
    private val execution by option(
        "--execution",
        metavar = "HOW",
        help = "bounded planner: run the whole-path, or a single-step, before planning again",
    ).oneOf(EXECUTIONS)
    private val choice by option(
        "--choice",
        metavar = "PATH",
        help = "bounded planner: run the best path, or the last-polled as the original code did",
    ).oneOf(CHOICES)

    private val neighbours by option(
        "--neighbours",
        metavar = "WHICH",
        help = "bounded planner: cells reached in one move, edge or edge-or-corner as in the original",
    ).oneOf(NEIGHBOURS)
    private val priority by option(
        "--priority",
        metavar = "WHAT",
        help = "bounded planner: expand the highest value-per-move first, or value as the original code did",
    ).oneOf(PRIORITIES)

    private val rrtIterations by option(
        "--rrt-iterations",
        metavar = "N",
        help = "polygon-rrt: points drawn for a plan",
    ).wholeNumber("a whole number within 1..${PolygonRrtSettings.MAX_ITERATIONS}") {
        it in 1..PolygonRrtSettings.MAX_ITERATIONS
    }
    private val rrtHorizon by option("--rrt-horizon", metavar = "CELLS", help = "polygon-rrt: longest path, in cells")
        .number("a number of cells above 0") { it > 0 }
    private val rrtReach by option("--rrt-reach", metavar = "CELLS", help = "polygon-rrt: longest leg, in cells")
        .number("a number of cells above 0") { it > 0 }
    private val margin by option(
        "--margin",
        metavar = "METRES",
        help = "with --area: smallest distance from land and keep-outs",
    ).number("a number of metres of at least 0") { it >= 0 }
    private val resolution by option(
        "--resolution",
        metavar = "METRES",
        help = "with --area: distance of the points among which ways through narrow water are " +
            "sought; half a cell unless given",
    ).number("a number of metres above 0") { it > 0 }

    /** [settings] with what was given on the command line in their place. */
    fun applied(settings: PlannerSettings): PlannerSettings = settings.copy(
        walk = walk ?: settings.walk,
        pattern = pattern ?: settings.pattern,
        bounded = settings.bounded.copy(
            horizon = horizon ?: settings.bounded.horizon,
            expansions = expansions ?: settings.bounded.expansions,
            maxChange = maxChange ?: settings.bounded.maxChange,
            discountVisits = discountVisits ?: settings.bounded.discountVisits,
            execution = execution ?: settings.bounded.execution,
            choice = choice ?: settings.bounded.choice,
            neighbours = neighbours ?: settings.bounded.neighbours,
            priority = priority ?: settings.bounded.priority,
        ),
        polygonRrt = settings.polygonRrt.copy(
            iterations = rrtIterations ?: settings.polygonRrt.iterations,
            horizon = rrtHorizon ?: settings.polygonRrt.horizon,
            reach = rrtReach ?: settings.polygonRrt.reach,
            margin = margin ?: settings.polygonRrt.margin,
            resolution = resolution ?: settings.polygonRrt.resolution,
        ),
        boundedExtended = BoundedExtendedPlannerSettings(
            horizon = horizon ?: settings.boundedExtended.horizon,
            expansions = expansions ?: settings.boundedExtended.expansions,
        ),
        information = settings.information.copy(horizon = horizon ?: settings.information.horizon),
    )

    /** What uses them. */
    internal val users = OptionUsers(
        mapOf("--walk" to OptionUser.planners(listOf(PlannerKind.RANDOM_WALK))) +
            listOf("--pattern").associateWith { OptionUser.planners(MOWING) } +
            listOf("--horizon").associateWith { OptionUser.planners(LOOKING_AHEAD) } +
            listOf("--expansions").associateWith { OptionUser.planners(EXPANDING) } +
            listOf(
                "--max-change",
                "--discount-visits",
                "--no-discount-visits",
                "--execution",
                "--choice",
                "--neighbours",
                "--priority",
            ).associateWith { OptionUser.planners(listOf(PlannerKind.BOUNDED)) } +
            listOf("--rrt-iterations", "--rrt-horizon", "--rrt-reach").associateWith {
                OptionUser.planners(listOf(PlannerKind.POLYGON_RRT))
            } +
            // Without an area all is water, as far as one likes from land.
            listOf("--margin", "--resolution").associateWith { OptionUser.option("--area") },
    )

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> = listOf(
        "--walk" to WALKS.nameOf(walk),
        "--pattern" to PATTERNS.nameOf(pattern),
        "--horizon" to horizon,
        "--expansions" to expansions,
        "--max-change" to maxChange,
        "--discount-visits" to (discountVisits == true),
        "--no-discount-visits" to (discountVisits == false),
        "--execution" to EXECUTIONS.nameOf(execution),
        "--choice" to CHOICES.nameOf(choice),
        "--neighbours" to NEIGHBOURS.nameOf(neighbours),
        "--priority" to PRIORITIES.nameOf(priority),
        "--rrt-iterations" to rrtIterations,
        "--rrt-horizon" to rrtHorizon,
        "--rrt-reach" to rrtReach,
        "--margin" to margin,
        "--resolution" to resolution,
    )

    private fun <T> Map<String, T>.nameOf(value: T?): String? = entries.find { it.value == value }?.key

    private companion object {
        const val LONGEST_HORIZON = 1000

        /** A tree of eight million nodes, 300 MB in each thread. */
        const val MOST_EXPANSIONS = 1_000_000
        val MOWING = listOf(PlannerKind.LAWNMOWER, PlannerKind.SETTLING_LAWNMOWER)
        val EXPANDING = listOf(PlannerKind.BOUNDED, PlannerKind.BOUNDED_EXTENDED)
        val LOOKING_AHEAD = EXPANDING + PlannerKind.INFORMATION
        val WALKS = mapOf("edge" to WalkSteps.EDGE, "diagonal" to WalkSteps.DIAGONAL_CLAMPED)
        val PATTERNS = mapOf(
            "hamiltonian-cycle" to LawnmowerPattern.HAMILTONIAN_CYCLE,
            "back-and-forth" to LawnmowerPattern.BACK_AND_FORTH,
            "rows-then-columns" to LawnmowerPattern.ROWS_THEN_COLUMNS,
            "four-directions" to LawnmowerPattern.FOUR_DIRECTIONS,
            "raster" to LawnmowerPattern.RASTER,
        )
        val EXECUTIONS = mapOf("whole-path" to Execution.WHOLE_PATH, "single-step" to Execution.SINGLE_STEP)
        val NEIGHBOURS = mapOf("edge" to Neighbours.EDGE, "edge-or-corner" to Neighbours.EDGE_OR_CORNER)
        val PRIORITIES = mapOf("value-per-move" to Priority.VALUE_PER_MOVE, "value" to Priority.VALUE)
        val CHOICES = mapOf("best" to PathChoice.BEST, "last-polled" to PathChoice.LAST_POLLED)
    }
}
