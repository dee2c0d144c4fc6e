package stillwater.run

import stillwater.estimate.BoundedFilterSettings
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.WaterArea
import stillwater.plan.Lawnmower
import stillwater.sensor.SensorSpec
import stillwater.world.RandomField

/**
 * A comparison of filters and planners in many random fields, as data.
 *
 * @property fields kinds of field by name, in the order of the results.
 * @property filters estimators under comparison.
 * @property planners planners under comparison.
 * @property sensor the boat's sensor.
 * @property boundedFilter settings of every bounded filter.
 * @property lagFilters what the filters that reckon with a lag may assume.
 * @property plannerSettings settings of the planners.
 * @property grid cells of every field.
 * @property prior range of a cell before it is measured, sensor units.
 * @property environments number of fields of each kind, at least 1.
 * @property moves moves in a trial, at least 1; the stay in the start cell is the first.
 * @property checkpoints moves at which the error is taken, ascending, within 1..[moves].
 * @property samplesPerMove readings in a cell, at least 1.
 * @property period time between readings, s, above 0.
 * @property seed where all chance comes from.
 * @property boats numbers of boats under comparison, each 1 to the number of cells.
 * @property budget what each boat may use before it has to be home; null for no end.
 * @property area the water, in the frame of [grid]; cells whose centre is not on it do not count. Null where all is water.
 *   Planners that go from cell to cell then go round land, at a speed as those in the plane.
 * @property speed of boats in an [area] or that go along waypoints in the plane, m/s; null for a cell's length a move.
 * @throws IllegalArgumentException if a number is out of its range or nothing is compared.
 */
data class ExperimentSettings(
    val fields: Map<String, RandomField>,
    val filters: List<FilterKind>,
    val planners: List<PlannerKind>,
    val sensor: SensorSpec,
    val boundedFilter: BoundedFilterSettings,
    val lagFilters: LagFilterSettings = LagFilterSettings(),
    val plannerSettings: PlannerSettings = PlannerSettings(),
    val grid: Grid = Grid.unit(10, 10),
    val prior: Interval = Interval.UNIT,
    val environments: Int = 100,
    val moves: Int = 2000,
    val checkpoints: List<Int> = Checkpoints.upTo(moves),
    val samplesPerMove: Int = 10,
    val period: Double = 1.0,
    val seed: Long = 1,
    val boats: List<Int> = listOf(1),
    val budget: Budget? = null,
    val area: WaterArea? = null,
    val speed: Double? = null,
) {
    /** All filters that run: [filters], and what planners plan on beside them. */
    internal val running: List<FilterKind>
        get() = planners.flatMap { PathGroup.of(it, filters) }.flatMap { it.filters }.distinct()

    init {
        require(fields.isNotEmpty()) { "fields must not be empty" }
        require(filters.isNotEmpty()) { "filters must not be empty" }
        require(planners.isNotEmpty()) { "planners must not be empty" }
        require(environments >= 1) { "environments ($environments) must be at least 1" }
        require(moves >= 1) { "moves ($moves) must be at least 1" }
        require(samplesPerMove >= 1) { "samplesPerMove ($samplesPerMove) must be at least 1" }
        require(period > 0 && period.isFinite()) { "period ($period s) must be above 0 and finite" }
        require(checkpoints.isNotEmpty()) { "checkpoints must not be empty" }
        require(checkpoints.zipWithNext().all { (a, b) -> a < b }) { "checkpoints ($checkpoints) must ascend" }
        require(checkpoints.first() >= 1 && checkpoints.last() <= moves) {
            "checkpoints ($checkpoints) must lie within 1..$moves"
        }
        require(boats.isNotEmpty() && boats.distinct() == boats && boats.all { it in 1..grid.size }) {
            "boats ($boats) must be different numbers within 1..${grid.size}, the number of cells"
        }
        require(PlannerKind.LAWNMOWER !in planners || Lawnmower.fits(grid, plannerSettings.pattern)) {
            "the Hamiltonian cycle needs an even number of rows or columns and two of each at least, " +
                "not ${grid.columns} x ${grid.rows}; choose another lawnmower pattern"
        }
    }
}
