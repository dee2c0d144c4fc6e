package stillwater.survey

import stillwater.estimate.BayesianMap
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.FieldEstimator
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.run.FilterKind
import stillwater.run.LagFilterSettings

/**
 * The filters of a [SurveyMap], which take all readings in turn, and what is asked of these beside.
 *
 * Confined to one thread.
 *
 * @property prior range of the field that they take. @param bounded settings of the bounded filter. @param lag those of the filters that reckon with a lag.
 * @param statistics what the readings look like.
 */
internal class MapFilters(
    settings: MapSettings,
    grid: Grid,
    val prior: Interval,
    bounded: BoundedFilterSettings,
    lag: LagFilterSettings,
    statistics: SurveyStatistics,
) {
    private val learnsFromAll = statistics.readings <= MOST_RECALLED
    private val learning = lag.selfCalibrating.copy(recalled = recalled(lag, statistics))
    private val estimators: Map<FilterKind, FieldEstimator>

    /** The estimator that learns of the sensor; null where none was asked for. */
    val learned: SelfCalibratingEstimator?

    /** What tells whether cells are even, where a filter takes that for granted. */
    private val judge: SelfCalibratingEstimator?
    private val running: Array<FieldEstimator>

    init {
        val assumed = lag.copy(selfCalibrating = learning)
        val made = settings.filters.associateWith { it.estimator(grid, prior, bounded, assumed) }
        // What a Bayesian map reads its cells with is the self-calibrating filter: learning once is enough.
        val shared = (made[FilterKind.BAYESIAN] as? BayesianMap)?.cells
        estimators = made.mapValues { (kind, own) -> shared?.takeIf { kind == FilterKind.SELF_CALIBRATING } ?: own }
        learned = estimators.values.firstNotNullOfOrNull(::learner)
        val isAsked = settings.correction == null && settings.filters.any { it.needsEvenCells }
        val needsOwn = learned == null && isAsked && statistics.readings <= MOST_JUDGED
        val own = if (needsOwn) SelfCalibratingEstimator(grid, prior, lag.selfCalibrating) else null
        judge = learned ?: own
        running = (estimators.values - setOfNotNull(shared) + listOfNotNull(own)).toTypedArray()
    }

    /** How well corrected readings are known; null where the readings themselves are mapped. */
    val corrected = settings.correction?.let { CorrectedCells(grid, it) }

    /** Without it the time over a border would be taken as spent in the second cell, where it was spent in both. */
    private val places = Conditions(mapOf(Conditions.POSITION_DEVIATION to statistics.placeDeviation))

    /** The filters' maps, in the order asked for. */
    val maps: Map<FilterKind, FieldMap> get() = estimators.mapValues { it.value.map }

    /** Whether cells are even as far as can be told; true where nobody asked. */
    val areCellsEven: Boolean get() = judge?.sensor()?.areCellsEven != false

    /** Takes the log's next reading; false where the log says nothing of the water there and then. */
    fun take(time: BoatTime, x: Double, y: Double, value: Double): Boolean {
        if (corrected?.take(x, y) == false) return false
        for (estimator in running) estimator.update(time, x, y, value, places)
        return true
    }

    /** There are no more readings: what is learned of the sensor is learned from all of them. */
    fun finish() {
        for (estimator in estimators.values) learner(estimator)?.learnFromAll()
    }

    /**
     * Those that [make] makes for a range as wide as what is known of the water's, with all that is [kept] taken; these where
     * that is no wider.
     */
    fun widened(kept: KeptReadings, make: (Interval) -> MapFilters): MapFilters {
        val wider = WaterRange.wider(prior, knownRange) ?: return this
        return make(wider).also { filters ->
            kept.read { time, x, y, value, _ -> filters.take(time, x, y, value) }
            filters.finish()
        }
    }

    /** What of the water's range was learned from all readings; null where that cannot be told. */
    val knownRange: Interval? get() = learned?.takeIf { learnsFromAll }?.knownRange()

    private companion object {
        /** A log of so many readings is learned from whole: a second or so. */
        const val MOST_RECALLED = 10_000

        /** All, where each may come after an interruption; of a longer log as many readings and interruptions from its start. */
        fun recalled(lag: LagFilterSettings, statistics: SurveyStatistics): Int {
            val all = 2 * minOf(statistics.readings, MOST_RECALLED.toLong()).toInt()
            return maxOf(all, lag.selfCalibrating.recalled)
        }

        /** Readings at most that are asked beside what was asked for: a fraction of a second. */
        const val MOST_JUDGED = 50_000

        /** The estimator that learns of the sensor, in [estimator] or itself. */
        fun learner(estimator: FieldEstimator): SelfCalibratingEstimator? =
            estimator as? SelfCalibratingEstimator ?: (estimator as? BayesianMap)?.cells as? SelfCalibratingEstimator
    }
}
