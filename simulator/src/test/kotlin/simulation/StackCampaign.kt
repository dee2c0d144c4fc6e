package stillwater.simulation

import stillwater.mission.EstimatorName
import stillwater.run.label
import stillwater.virtual.BoardSpec
import stillwater.world.WaterKind
import stillwater.world.WorldSettings
import java.util.Locale
import kotlin.system.exitProcess

/** What the whole stack adds to a map's error: a mission's map against that of the same readings in process; docs/simulate.md. */
private class StackCampaign(private val seeds: LongRange) {
    private val board = BoardSpec(oxygenPeriod = 1.0)

    fun row(water: WaterKind, estimator: EstimatorName): String {
        val planner = when (estimator) {
            EstimatorName.SELF_CALIBRATING -> "lawnmower"
            EstimatorName.BAYESIAN -> "information"
            else -> "bounded-extended"
        }
        val spec = SmallMission.tenByTen(estimator.label, planner)
        val results = seeds.map { SmallMission.sail(spec, WorldSettings(seed = it, water = water, board = board)) }
        val ratios = results.map { it.comparedError.mean / it.inProcessError.mean }
        val afloat = results.sumOf { it.comparedError.mean } / results.size
        val inProcess = results.sumOf { it.inProcessError.mean } / results.size
        val averages = results.sumOf { it.averagesError.mean } / results.size
        val holding = results.sumOf { it.boundsAtCentres.holding } / results.size
        return listOf(
            water.name.lowercase(),
            "${estimator.label}, $planner",
            number(afloat),
            number(inProcess),
            number(afloat / inProcess),
            "${number(ratios.min())} to ${number(ratios.max())}",
            "${ratios.count { it > 1 + MARGIN }} of ${results.size}",
            number(averages),
            number(holding),
        ).joinToString(" | ", "| ", " |")
    }

    private fun number(value: Double) = if (value.isNaN()) "none" else String.format(Locale.ROOT, "%.3g", value)

    companion object {
        /** The bar. */
        const val MARGIN = 0.1
    }
}

/** Arguments: first seed, number of seeds, and estimators by name; without any those that learn the sensor. */
fun main(args: Array<String>) {
    if (args.size < 2) {
        System.err.println("arguments: FIRST COUNT [ESTIMATOR...]")
        exitProcess(2)
    }
    val first = args[0].toLong()
    val campaign = StackCampaign(first until first + args[1].toLong())
    val named = args.drop(2).map { label -> EstimatorName.entries.single { it.label == label } }
    println(
        "| water | estimator, planner | mission | in process | ratio | each seed | above 1.1 | cells' averages | bounds hold |",
    )
    println("|---|---|---|---|---|---|---|---|---|")
    for (water in listOf(WaterKind.GAUSSIAN, WaterKind.SMOOTH)) {
        for (estimator in named.ifEmpty { listOf(EstimatorName.SELF_CALIBRATING, EstimatorName.BAYESIAN) }) {
            println(campaign.row(water, estimator))
        }
    }
}
