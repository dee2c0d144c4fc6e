package stillwater.benchmark

import stillwater.report.Align
import stillwater.report.SignificantDigits
import stillwater.report.Table
import stillwater.report.TableColumn
import stillwater.run.Curve
import stillwater.run.ExperimentResult

/** How much of their budget boats used, and whether they came home. */
object BudgetTable {
    /** Columns of budget.csv. */
    val COLUMNS: List<String> = listOf(
        "field", "filter", "planner", "boats", "budget", "limit", "mean_used", "most_used", "share_home",
    )

    /** Rows of budget.csv; none without a budget. Means over the environments of the boat that used most. */
    fun rows(result: ExperimentResult): List<List<Any>> {
        val budget = result.settings.budget ?: return emptyList()
        return result.curves.map { curve ->
            listOf(curve.field, curve.filter.label, curve.planner.label, curve.boats, budget.kind.label, budget.limit) +
                listOf(curve.budgets.map { it.used }.average(), curve.budgets.maxOf { it.used }, home(curve))
        }
    }

    /** The same for people; null without a budget. */
    fun of(result: ExperimentResult): Table? {
        if (result.settings.budget == null) return null
        val format = SignificantDigits(DIGITS)
        return Table(
            listOf("field", "planner", "filter").map { TableColumn(it, Align.LEFT) } +
                listOf("boats", "mean used", "most used", "home").map { TableColumn(it, Align.RIGHT) },
            result.curves.map { curve ->
                val used = curve.budgets.map { it.used }
                listOf(curve.field, curve.planner.label, curve.filter.label, "${curve.boats}") +
                    listOf(format.format(used.average()), format.format(used.max()), percent(home(curve)))
            },
        )
    }

    /** Warns where a trial ended before its boats were home. */
    fun warnings(result: ExperimentResult): List<String> {
        val budget = result.settings.budget ?: return emptyList()
        val home = result.curves.minOf(::home)
        if (home == 1.0) return emptyList()
        return listOf(
            "as few as ${percent(
                home,
            )} of the boats were home after ${result.settings.moves} moves; more --moves let " +
                "them use up ${budget.limit} ${budget.kind.unit}",
        )
    }

    private fun home(curve: Curve) = curve.budgets.sumOf { it.home }.toDouble() / (curve.budgets.size * curve.boats)

    private fun percent(share: Double) = "${Math.floor(share * PERCENT).toInt()} %"

    private const val PERCENT = 100
    private const val DIGITS = 4
}
