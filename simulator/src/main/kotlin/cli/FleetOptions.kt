package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.option
import stillwater.io.AreaFile
import stillwater.io.AreaUnits
import stillwater.io.JsonFileProblem
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.run.Budget
import stillwater.run.BudgetKind
import stillwater.run.PlannerKind
import java.nio.file.Path
import kotlin.math.ceil

/** The options of boats, their budgets and the water they are on. */
class FleetOptions : OptionGroup(name = "Boats and water") {
    private val boats by option(
        "--boats",
        metavar = "NUMBERS",
        help = "boats that share one map, such as 4, or 1,2,4,8 to compare; 1 unless given",
    ).convert { text ->
        val numbers = text.split(',').map { it.trim().toIntOrNull() ?: 0 }
        if (numbers.any { it !in 1..MOST_BOATS } || numbers.distinct() != numbers) {
            throw BadFlag(name, "different numbers of boats within 1..$MOST_BOATS such as 1,2,4,8", "'$text'")
        }
        numbers
    }
    private val budgetMoves by option(
        "--budget-moves",
        metavar = "N",
        help = "moves after which each boat has to be back at its start; it plans accordingly",
    ).wholeNumber("a whole number above 0") { it > 0 }
    private val budgetDistance by option("--budget-distance", metavar = "METRES", help = "the same as a distance")
        .number("a number of metres above 0") { it > 0 }
    private val budgetTime by option("--budget-time", metavar = "SECONDS", help = "the same as a time")
        .number("a number of seconds above 0") { it > 0 }
    private val area by option(
        "--area",
        metavar = "FILE",
        help = "GeoJSON with the water as a Polygon and its islands as holes; Polygons with the property " +
            "\"keep-out\": true are kept out of",
    )
    private val areaUnits by option(
        "--area-units",
        metavar = "UNITS",
        help = "the area's coordinates: degrees (longitude, latitude) or metres (east, north); degrees unless given",
    ).oneOf(AreaUnits.entries.associateBy { it.label })
    private val cell by option(
        "--cell",
        metavar = "METRES",
        help = "side of the square cells laid over the area; a tenth of its longer side unless given",
    ).number("a number of metres above 0") { it > 0 }
    private val speed by option(
        "--speed",
        metavar = "M/S",
        help = "with --area, and polygon-rrt: speed of the boats; a cell's length a move unless given",
    ).number("a number above 0") { it > 0 }

    /** Numbers of boats, or null where none was given. */
    fun boats(): List<Int>? = boats

    /** Speed, m/s, or null where none was given. */
    fun speed(): Double? = speed

    /** Whether an area was given. */
    val hasArea: Boolean get() = area != null

    /** The budget, or null where none was given. */
    fun budget(): Budget? {
        val given = listOfNotNull(
            budgetMoves?.let { Budget(BudgetKind.MOVES, it.toDouble()) },
            budgetDistance?.let { Budget(BudgetKind.DISTANCE, it) },
            budgetTime?.let { Budget(BudgetKind.TIME, it) },
        )
        if (given.size > 1) {
            throw BadFlag("--budget-${given[1].kind.label}", "one budget", "--budget-${given[0].kind.label} too")
        }
        return given.singleOrNull()
    }

    /** The water, or null where none was given. */
    fun area(): WaterArea? {
        val path = area ?: return null
        return try {
            AreaFile.read(Path.of(path), areaUnits ?: AreaUnits.DEGREES)
        } catch (wrong: JsonFileProblem) {
            throw BadFlag("--area", wrong)
        }
    }

    /** Square cells over all of [area]. */
    fun grid(area: WaterArea): Grid {
        val wide = area.east - area.west
        val high = area.north - area.south
        val side = cell ?: (maxOf(wide, high) / CELLS_ALONG)
        // A side that divides the area evenly must not make one more cell of its rounding.
        val columns = ceil(wide / side - ROUNDING)
        val rows = ceil(high / side - ROUNDING)
        if (columns * rows > MOST_CELLS) {
            throw BadFlag("--cell", "cells of a size that at most $MOST_CELLS cover the area", "$side m")
        }
        val atLeastOne = { count: Double -> maxOf(1, count.toInt()) }
        return Grid(
            Position(
                (area.west + area.east - atLeastOne(columns) * side) / 2,
                (area.south + area.north - atLeastOne(rows) * side) / 2,
            ),
            atLeastOne(columns),
            atLeastOne(rows),
            side,
        )
    }

    /** What uses them. */
    internal val users = OptionUsers(
        mapOf(
            "--area-units" to OptionUser.option("--area"),
            "--cell" to OptionUser.option("--area"),
            "--speed" to OptionUser.option("--area") + OptionUser.planners(PlannerKind.entries.filter { it.inPlane }),
        ),
    )

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> = listOf(
        "--boats" to boats?.joinToString(","),
        "--budget-moves" to budgetMoves,
        "--budget-distance" to budgetDistance,
        "--budget-time" to budgetTime,
        "--area" to area,
        "--area-units" to areaUnits?.label,
        "--cell" to cell,
        "--speed" to speed,
    )

    private companion object {
        const val MOST_BOATS = 10_000
        const val CELLS_ALONG = 10.0
        const val MOST_CELLS = 1_000_000
        const val ROUNDING = 1e-9
    }
}
