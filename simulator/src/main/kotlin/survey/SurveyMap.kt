package stillwater.survey

import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.async
import kotlinx.coroutines.channels.Channel
import kotlinx.coroutines.channels.consumeEach
import kotlinx.coroutines.channels.trySendBlocking
import kotlinx.coroutines.coroutineScope
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.EpsilonCalibration
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.field.FieldMap
import stillwater.io.FixReach
import stillwater.io.LogPass
import stillwater.io.LogProblem
import stillwater.io.ReadingSink
import stillwater.io.SquareReach
import stillwater.io.SurveyLog
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.run.FilterKind
import stillwater.run.LagFilterSettings

/**
 * How to make maps out of a log; what is null is chosen from the log.
 *
 * @property filters filters to run, each once, in this order.
 * @property grid wishes about the grid.
 * @property prior range of the field, sensor units.
 * @property epsilon smallest slope that counts as one, sensor units/s.
 * @property calibrate stretch to find epsilon on, where [epsilon] is null; null for the quietest.
 * @property boundedFilter settings of the bounded filter; its epsilon stands back behind [epsilon].
 * @property unit unit of the quantity, as it is to be shown.
 * @property lagFilters what the filters that reckon with a lag may assume.
 * @property correction what is mapped in place of the readings, or null.
 * @property slowestGiven whether the user gave the interval filter's longest time constant.
 * @property readingErrorGiven whether the user gave its largest error of a reading; if not, and if it is 0, the step of
 *   the log's values stands for it.
 */
data class MapSettings(
    val filters: List<FilterKind> = FilterKind.entries,
    val grid: GridWish = GridWish(),
    val prior: Interval? = null,
    val epsilon: Double? = null,
    val calibrate: Stretch? = null,
    val boundedFilter: BoundedFilterSettings = BoundedFilterSettings(epsilon = 0.0),
    val unit: String? = null,
    val lagFilters: LagFilterSettings = LagFilterSettings(),
    val correction: GivenCorrection? = null,
    val slowestGiven: Boolean = false,
    val readingErrorGiven: Boolean = false,
)

/**
 * A log turned into maps, with all that was found out on the way.
 *
 * @property log the log. @property pass what reading it came to. @property statistics what it looks like.
 * @property track its track, thinned. @property grid the grid.
 * @property calibration how epsilon was found, or null where it was given or nobody needed it.
 * @property bounded settings of the bounded filter, or null where it did not run.
 * @property gaps silences longer than five median steps. @property passes passes through the same cells compared.
 * @property legs the straight legs. @property mismatch their comparison, or null where there is too little.
 * @property outsideRange readings outside [prior].
 * @property stepSlope slope that one step of the resolution makes in the slope window, sensor units/s; 0 without one.
 * @property settings what was asked for. @property interval what the interval filter's bounds assume, or null where it
 *   did not run.
 */
class SurveyMap internal constructor(
    val log: SurveyLog,
    val pass: LogPass,
    val statistics: SurveyStatistics,
    val track: Track,
    val grid: Grid,
    val calibration: Calibration?,
    val bounded: BoundedFilterSettings?,
    private val filters: MapFilters,
    val gaps: Gaps,
    val passes: CellPasses,
    val legs: Legs,
    val mismatch: LegMismatch?,
    val outsideRange: Long,
    val stepSlope: Double,
    val settings: MapSettings,
    val interval: IntervalAssumption?,
) {
    /** The filters' maps, in the order asked for. */
    val maps: Map<FilterKind, FieldMap> = filters.maps

    /** The estimator that learned the time constant, or null where it did not run. */
    val learned: SelfCalibratingEstimator? get() = filters.learned

    /** Range of the field taken, sensor units. */
    val prior: Interval get() = filters.prior

    /** How well the corrected readings of each cell are known; null where the readings themselves are mapped. */
    val corrected: CorrectedCells? get() = filters.corrected

    /**
     * Whether the readings bear out that the water changes at the cells' borders and not within them, which bounds take for
     * granted; true where nobody takes that for granted, or it cannot be told.
     */
    val areCellsEven: Boolean by lazy { filters.areCellsEven }

    /** Whether the user gave [prior]. */
    val rangeGiven: Boolean get() = settings.prior != null

    /** Whether [prior] holds what the filter that learned the sensor knows of the water's range: only of short logs. */
    val isRangeLearned: Boolean get() = !rangeGiven && filters.knownRange != null

    /** Whether it is wider for that than the readings and a tenth more. */
    val isRangeWidened: Boolean get() = isRangeLearned && prior != WaterRange.ofReadings(statistics)

    /** Whether the user gave the bounded filter's epsilon. */
    val epsilonGiven: Boolean get() = settings.epsilon != null

    /** Unit of the quantity as the user gave it, or null. */
    val unit: String? get() = settings.unit

    /**
     * What the filter [kind] says that the water of [cell] lies between; null where it says nothing. Crossed bounds have the
     * lower one above.
     */
    fun bounds(kind: FilterKind, cell: Int): CellBounds? {
        val field = maps.getValue(kind)
        val status = field.status(kind, cell)
        return when {
            !status.isMeasured -> null
            status != CellStatus.MEASURED -> CellBounds(field.lower(cell), field.upper(cell))
            kind == FilterKind.AVERAGING -> corrected?.let { CellBounds(it.lower(cell), it.upper(cell)) }
            else -> null
        }
    }

    /** What was mapped in place of the readings, or null. */
    val correction: GivenCorrection? get() = settings.correction

    companion object {
        private const val METRES_A_KILOMETRE = 1000

        /** So many blocks of readings may wait for the first look. */
        private const val BLOCKS_AHEAD = 4

        /**
         * Goes through [log] twice: once to see what it is, once into the filters. Read again is only what is too long
         * to be kept. What is read is looked at on another core, and so are the legs compared while the filters run.
         *
         * @param progress told how many bytes of the two readings are done.
         * @throws LogProblem if the log cannot be used.
         */
        fun of(log: SurveyLog, settings: MapSettings, progress: (Long) -> Unit = {}): SurveyMap =
            runBlocking { read(log, settings, progress) }

        /** Refuses cells so large that their corners would have no latitude. */
        private fun requireOnGlobe(log: SurveyLog, wish: GridWish) {
            if (log.frame == null || wish.cell == null || wish.cell <= FixReach.LIMIT_METRES) return
            val most = (FixReach.LIMIT_METRES / METRES_A_KILOMETRE).toInt()
            throw UnfitGrid("expected cells of at most $most km in a log with latitudes, found ${wish.cell} m")
        }

        private suspend fun read(log: SurveyLog, settings: MapSettings, progress: (Long) -> Unit) = coroutineScope {
            val look = FirstLook(settings)
            var bytes = 0L
            val first = look(log, settings, look) { progress(it.also { bytes = it }) }
            if (first.readings < 2) throw tooFew(log, first)
            val statistics = look.scan.statistics()
            SquareReach.require(log, doubleArrayOf(statistics.lowest, statistics.highest))
            val track = look.scan.track()
            val legs = LegFinder(statistics).find(track)
            val mismatch = async(Dispatchers.Default) { LegComparison(statistics, track).compare(legs) }
            val stepSlope = stepSlope(statistics, settings)
            val calibration = look.epsilon.calibration(log)?.atLeast(stepSlope)
            requireOnGlobe(log, settings.grid)
            val grid = GridChoice(statistics, track).grid(settings.grid)
            val prior = settings.prior ?: WaterRange.ofReadings(statistics)
            val bounded = boundedSettings(settings, calibration)
            val forBounded = bounded ?: BoundedFilterSettings(epsilon = 0.0)
            val interval = interval(settings, statistics)
            val lag = settings.lagFilters.copy(interval = interval.settings)
            fun filters(range: Interval) = MapFilters(settings, grid, range, forBounded, lag, statistics)
            val filters = filters(prior)
            val passes = CellPasses(grid)
            val gaps = Gaps(statistics.gapLimit)
            var outsideRange = 0L
            val takeIn = ReadingSink { time, x, y, value, _ ->
                gaps.add(time.seconds, x, y)
                if (!filters.take(time, x, y, value)) return@ReadingSink
                passes.add(x, y, value)
                if (value !in prior.lower..prior.upper) outsideRange++
            }
            val kept = look.kept
            if (kept.holds(first.readings)) kept.read(takeIn) else log.read(settings, { progress(bytes + it) }, takeIn)
            progress(2 * bytes)
            filters.finish()
            val mayWiden = settings.prior == null && kept.holds(first.readings)
            passes.finish()
            SurveyMap(
                log,
                first,
                statistics,
                track,
                grid,
                calibration,
                bounded,
                if (mayWiden) filters.widened(kept, ::filters) else filters,
                gaps,
                passes,
                legs,
                mismatch.await(),
                outsideRange,
                stepSlope,
                settings,
                interval.takeIf { FilterKind.INTERVAL in settings.filters },
            )
        }

        /** Reads [log] on this thread while [look] takes on another what was read before. */
        private suspend fun look(
            log: SurveyLog,
            settings: MapSettings,
            look: FirstLook,
            progress: (Long) -> Unit,
        ): LogPass = coroutineScope {
            val blocks = Channel<ReadingBlock>(BLOCKS_AHEAD)
            val looking = launch(Dispatchers.Default) { blocks.consumeEach(look::take) }
            var block = ReadingBlock()
            val pass = log.read(settings, progress) { time, x, y, value, _ ->
                block.add(time.seconds, x, y, value)
                if (block.isFull) {
                    blocks.trySendBlocking(block).getOrThrow()
                    block = ReadingBlock()
                }
            }
            blocks.send(block)
            blocks.close()
            looking.join()
            pass
        }

        /** Hands what is to be mapped to [sink]: the readings, or what is given in their place. */
        private fun SurveyLog.read(settings: MapSettings, progress: (Long) -> Unit, sink: ReadingSink): LogPass {
            val correction = settings.correction ?: return read(progress, sink)
            var row = 0
            return read(progress) { time, x, y, _, conditions ->
                sink.take(time, x, y, correction.at(row++), conditions)
            }
        }

        private fun tooFew(log: SurveyLog, pass: LogPass): LogProblem {
            val skipped = pass.skipped.entries.joinToString("") { "; ${it.value} ${it.key}" }
            val found = pass.readings.toString() + skipped
            return LogProblem(log.file, null, null, "at least 2 readings of ${log.quantity}", found)
        }

        private fun stepSlope(statistics: SurveyStatistics, settings: MapSettings): Double {
            val resolution = statistics.resolution.takeIf { it.isFinite() } ?: return 0.0
            val step = statistics.steps.median.takeIf { it > 0 } ?: return 0.0
            return EpsilonCalibration.stepSlope(resolution, step, settings.boundedFilter.slopeWindow)
        }

        /** Where no reading error was given, the step in which the log's values are rounded stands for it. */
        private fun interval(settings: MapSettings, statistics: SurveyStatistics): IntervalAssumption {
            val asked = settings.lagFilters.interval
            val origin = when {
                settings.readingErrorGiven || asked.readingError > 0 -> ErrorOrigin.GIVEN
                statistics.resolution.isFinite() -> ErrorOrigin.RESOLUTION
                else -> ErrorOrigin.NONE
            }
            val taken =
                if (origin == ErrorOrigin.RESOLUTION) asked.copy(readingError = statistics.resolution) else asked
            return IntervalAssumption(taken, settings.slowestGiven, origin)
        }

        private fun boundedSettings(settings: MapSettings, calibration: Calibration?) = settings.boundedFilter
            .copy(epsilon = settings.epsilon ?: calibration?.epsilon ?: 0.0)
            .takeIf { FilterKind.BOUNDED in settings.filters }
    }
}
