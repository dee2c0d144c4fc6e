package stillwater.benchmark

import stillwater.plot.AxisScale
import stillwater.plot.Drawing
import stillwater.plot.LinePlot
import stillwater.plot.Mark
import stillwater.plot.Series
import stillwater.report.Align
import stillwater.report.SignificantDigits
import stillwater.report.Table
import stillwater.report.TableColumn
import stillwater.run.Checkpoints
import stillwater.run.Curve
import stillwater.run.ExperimentResult
import stillwater.run.Preset

/** Errors against the number of boats at equal time. */
object FleetFigures {
    /** Names of the figures' files, without ending, that any run may write. */
    val names: List<String> = listOf(Preset.UNIFORM, Preset.GAUSSIAN).map { "boats-$it" }

    /** One figure a field, by name; none where only one number of boats was run. */
    fun of(result: ExperimentResult): List<Pair<String, Drawing>> {
        if (result.settings.boats.size < 2) return emptyList()
        return result.settings.fields.keys.map { field -> "boats-$field" to drawing(result, field) }
    }

    private fun drawing(result: ExperimentResult, field: String): Drawing {
        val moves = moves(result)
        return LinePlot(
            title = "Error against boats at equal time, field $field",
            subtitle = "Mean over ${result.settings.environments} environments, bands of one standard error" +
                if (moves.size ==
                    1
                ) {
                    ", move ${moves.single()}"
                } else {
                    combinations(result, field).keys.single().let { ", $it" }
                },
            series = combinations(result, field).flatMap { (name, curves) ->
                moves.map { move ->
                    series(if (moves.size == 1) name else "move $move", curves.sortedBy { it.boats }, move)
                }
            },
            xLabel = "Boats",
            yLabel = "Mean absolute error",
            xScale = AxisScale.LOG10,
            yScale = AxisScale.LOG10,
        )
    }

    private fun series(name: String, curves: List<Curve>, move: Int): Series {
        val at = curves.map { it.at(move) }
        val spread = at.map { if (it.standardError.isNaN()) 0.0 else it.standardError }
        return Series(
            name,
            DoubleArray(curves.size) { curves[it].boats.toDouble() },
            DoubleArray(curves.size) { at[it].mean },
            DoubleArray(curves.size) { at[it].mean - spread[it] },
            DoubleArray(curves.size) { at[it].mean + spread[it] },
            Mark.LINE_AND_POINTS,
        )
    }

    /**
     * How much sooner more boats are there: a row per combination and number of boats, the error at the last checkpoint and
     * the first by which the fewest boats' last error is reached; null where only one number of boats was run.
     */
    fun table(result: ExperimentResult, field: String): Table? {
        if (result.settings.boats.size < 2) return null
        val format = SignificantDigits(DIGITS)
        val last = result.settings.checkpoints.last()
        val rows = combinations(result, field).flatMap { (_, curves) ->
            val goal = curves.minBy { it.boats }.at(last).mean
            curves.sortedBy { it.boats }.map { curve ->
                val reached = curve.checkpoints.firstOrNull { curve.at(it).mean <= goal }
                listOf(
                    curve.planner.label,
                    curve.filter.label,
                    "${curve.boats}",
                    format.format(curve.at(last).mean),
                    reached?.toString() ?: "later",
                )
            }
        }
        return Table(
            listOf(
                TableColumn("planner", Align.LEFT),
                TableColumn("filter", Align.LEFT),
                TableColumn("boats", Align.RIGHT),
                TableColumn("at $last", Align.RIGHT),
                TableColumn("reached by", Align.RIGHT),
            ),
            rows,
        )
    }

    private fun combinations(result: ExperimentResult, field: String): Map<String, List<Curve>> =
        result.curves.filter { it.field == field }.groupBy { "${it.planner.label}, ${it.filter.label}" }

    /** One combination is shown at every named moment, several at the last only. */
    private fun moves(result: ExperimentResult): List<Int> {
        val taken = result.settings.checkpoints
        val isOne = result.settings.planners.size * result.settings.filters.size == 1
        return if (isOne) (Checkpoints.NAMED + taken.last()).filter { it in taken }.distinct() else listOf(taken.last())
    }

    private const val DIGITS = 3
}
