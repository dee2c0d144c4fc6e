package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * Maps the field through a slow sensor and learns on the way what kind of sensor it is, and how slow.
 *
 * Model: one of [SensorKind], z = s + e with s the sensor's state, which goes on over cell borders, and e independent
 * with variance σ². Which one, its parameters, σ and every cell's ψ are unknown; a time constant is believed beforehand
 * as [SelfCalibratingSettings] say. The first-order lag τ ṡ = ψ − s is kept as long as the readings do not speak
 * against it; [sensor] says which models are still possible. A cell's value is its truth at the most likely parameters
 * of the chosen model; its bounds are credible at 95 %, the uncertainty of parameters and σ included, and cut to the
 * prior; where another model is possible too they hold what either says. What a visit says of its cell rests on the
 * readings there, on the sensor's state on entering and on the readings in the cell after; visits of one cell are
 * pooled. A cell never visited keeps the prior.
 *
 * Assumes the field constant within a cell and in time, and that the interval between two readings in different cells
 * is spent in the second: sample often on a border. Where readings say how well their places are known, in
 * [Conditions.POSITION_DEVIATION], that is not assumed: those nearer to a border than it count for no cell, and where it is
 * small against the boat's way from one reading to the next their places tell when it crossed. Between cells that do not
 * touch, or after leaving the grid or a reading without a value in another cell, the sensor's state is taken as unknown. A
 * reading farther than [FARTHEST] widths of the prior from its middle is not used and counts as a conflict. Where no model
 * explains the readings [isExplained] says so: bounds are then those of a [BoundedExtendedFilter], which needs no model,
 * and so are values if the nearest model's have run away from it.
 *
 * Source: own result, core/docs/SelfCalibratingEstimator.md; sums of innovations as in Schweppe 1965,
 * doi:10.1109/TIT.1965.1053737. The first [SelfCalibratingSettings.recalled] readings are kept and gone through again
 * each time their number has grown by half, so a reading is O(1) on average and at worst O(recalled); no call allocates
 * once the cells' memory has grown. New parameters change all cells: the map follows some cells each time the boat moves
 * on, [REFRESHED], and the boat's own and the one before when it is asked for. Confined to one thread.
 *
 * @param grid the cells.
 * @param prior the range of the field: a cell's value before it is measured has its midpoint, and, for what is
 *   computed, its width as standard deviation; sensor units.
 * @property settings what is believed of the sensor beforehand.
 * @property work most to be done for a reading in going through the kept readings again, steps of a filter, above 0:
 *   [AT_ONCE] or [AFLOAT].
 * @throws IllegalArgumentException if [work] is not above 0.
 */
public class SelfCalibratingEstimator(
    private val grid: Grid,
    prior: Interval,
    public val settings: SelfCalibratingSettings = SelfCalibratingSettings(),
    public val work: Double = AT_ONCE,
) : CellEstimator(grid, prior) {
    private val middle = prior.midpoint
    private val scale = if (prior.width > 0 && prior.width.isFinite()) prior.width else 1.0
    private val learner: SensorLearner
    private val choice: SensorChoice get() = learner.choice
    private val slots = IntArray(grid.size) { LagBank.NONE }
    private var visited = IntArray(FIRST_CELLS)
    private var visitedCount = 0
    private var refreshed = 0
    private var unrefreshed = 0
    private var lastCell = Grid.OUTSIDE
    private var lastSlot = LagBank.NONE
    private val fallback = Fallback(grid, prior)
    private val place = Place(grid.cellWidth, grid.cellHeight)

    /** Whether the boat's cell and the one before are to be written as the last reading left them. */
    private var isDue = false

    init {
        require(work > 0) { "work ($work filters' steps a reading) must be above 0" }
        learner = SensorLearner(settings, work, grid)
    }

    /**
     * The most likely time constant τ of a first-order lag, s; with an asymmetric response the geometric mean of the
     * two, with a second-order one their sum, with a slew limit what a first-order lag comes closest with.
     */
    public val timeConstant: Double get() = choice.timeConstant

    /**
     * Whether the chosen sensor model explains the readings: successive innovations are not clearly alike, and cells
     * are even and their water steady as far as can be told, see [SensorBelief]. Where it does not, the map's bounds need no
     * sensor model, and its values are the nearest model's or need none either. True until there is evidence
     * against it; then false until innovations are clearly unlike.
     */
    public val isExplained: Boolean get() = choice.isExplained

    /** Standard deviation of the logarithm of [timeConstant]: its relative uncertainty, dimensionless. */
    public val relativeUncertainty: Double get() = choice.relativeUncertainty

    /** Standard deviation σ of the readings about the sensor's state, noise and resolution together, sensor units. */
    public val noise: Double get() = scale * sqrt(choice.active.noiseVariance)

    /** Readings near borders or right behind one that told of the sensor but of no cell. */
    public var unplaced: Long = 0
        private set

    /** Where [timeConstant] lies with a probability of 95 %, s. Allocates. */
    public fun timeConstantInterval(): Interval {
        val spread = quantile(choice.active) * relativeUncertainty
        return Interval(timeConstant * exp(-spread), timeConstant * exp(spread))
    }

    /** Which sensor models the readings leave possible, and with what parameters. Allocates. */
    public fun sensor(): SensorBelief = choice.belief(scale)

    /**
     * Learns the sensor from all readings so far, not only from those there were when their number had last grown by half:
     * for the end of a survey. Nothing is done where there were more than are kept.
     */
    public fun learnFromAll() {
        if (learner.learnFromAll()) writeAll()
    }

    /**
     * From the lowest to the highest value of the cells that are known well, their intervals no wider than a quarter of the
     * prior, sensor units. Unlike the map's values these are not cut to the prior: a lag may show the water's range where
     * the readings' own falls short of it. Null where [isExplained] is false or no cell is known so well. Allocates.
     */
    public fun knownRange(): Interval? {
        if (!isExplained) return null
        var lowest = Double.POSITIVE_INFINITY
        var highest = Double.NEGATIVE_INFINITY
        for (slot in 0 until visitedCount) {
            val truth = choice.active.truth(slot)
            val reach = quantile(choice.active) * sqrt(choice.active.variance())
            if (!(reach <= WELL_KNOWN)) continue
            lowest = minOf(lowest, truth)
            highest = maxOf(highest, truth)
        }
        return if (lowest <= highest) Interval(middle + scale * lowest, middle + scale * highest) else null
    }

    override val map: FieldMap get() {
        writeDue()
        return written
    }

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        val scaled = (value - middle) / scale
        val isUsed = abs(scaled) <= FARTHEST
        fallback.take(cell, isUsed, seconds, value, conditions)
        if (!isUsed) {
            written.countConflict(cell)
            if (cell != lastCell) leave()
            return
        }
        if (cell != lastCell) enter(cell)
        noticePlace(conditions)
        if (learner.add(slots[cell], seconds, scaled, place)) writeAll()
        val slot = choice.crossings.slot(slots[cell], seconds, place)
        if (slot < 0) unplaced++
        val movesOn = slot != lastSlot
        if (movesOn) {
            writeDue()
            refresh()
        }
        lastSlot = slot
        unrefreshed++
        // A fit that begins judges, too, before any of it is done.
        val wasExplained = isExplained
        if (learner.learn()) {
            writeAll()
            return
        }
        if (!learner.isComplete) choice.follow()
        val before = choice.active.before
        if (slot != Crossings.PASSED_OVER) {
            if (choice.crossings.isTimed) choice.enter(slot, choice.crossings.from, choice.crossings.until)
            choice.take(slot, seconds, scaled)
        }
        if (isExplained != wasExplained) {
            // Bounds that no longer hold, or hold again, do so in all cells.
            writeAll()
            return
        }
        isDue = true
        // Water that is seen late: this is the last that the visit says of the cell.
        if (!movesOn && before != LagBank.NONE && before != choice.active.before) write(before)
    }

    /** Cells follow what was learned of the sensor since they were written. */
    private fun refresh() {
        // While all readings are kept what is known of the sensor still changes much.
        repeat(minOf(unrefreshed, if (learner.isComplete) visitedCount else REFRESHED)) {
            if (++refreshed >= visitedCount) {
                refreshed = 0
                compareWithFallback()
            }
            write(refreshed)
        }
        unrefreshed = 0
    }

    /**
     * Writes the cells that the boat's last reading told of. That is put off for as long as the next reading tells of
     * the same ones, and nothing is lost by it: each time they are written anew.
     */
    private fun writeDue() {
        if (!isDue) return
        isDue = false
        val last = slots[lastCell]
        write(last)
        val here = choice.active.here
        if (here != LagBank.NONE && here != last) write(here)
        if (choice.active.before != LagBank.NONE) write(choice.active.before)
    }

    /** Where the reading with [conditions] was taken, and how well that is known. */
    private fun noticePlace(conditions: Conditions) {
        if (conditions === Conditions.NONE) return place.forget()
        val deviation = conditions[Conditions.POSITION_DEVIATION]
        if (!(deviation >= 0)) return place.forget()
        place.set(alongColumns(), alongRows(), deviation, isNearBorder = distanceToBorder() < deviation)
    }

    private fun writeAll() {
        isDue = false
        compareWithFallback()
        for (i in 0 until visitedCount) write(i)
    }

    /** Where nothing explains the readings: whether the nearest model's values are to be kept. */
    private fun compareWithFallback() {
        if (isExplained) return
        fallback.begin()
        for (i in 0 until visitedCount) fallback.compare(visited[i], middle + scale * choice.active.truth(i))
        fallback.decide(choice.timeConstant / learner.meanStay())
    }

    private fun enter(cell: Int) {
        writeDue()
        if (lastCell != Grid.OUTSIDE && !touch(lastCell, cell)) leave()
        lastCell = cell
        if (slots[cell] == LagBank.NONE) {
            if (visitedCount == visited.size) visited = visited.copyOf(minOf(2 * visitedCount, grid.size))
            visited[visitedCount] = cell
            slots[cell] = visitedCount++
        }
    }

    override fun leave() {
        if (lastCell == Grid.OUTSIDE) return
        writeDue()
        lastCell = Grid.OUTSIDE
        fallback.leave()
        if (learner.add(LagBank.NONE, 0.0, 0.0)) writeAll()
        val wasExplained = isExplained
        choice.leave()
        choice.crossings.leave()
        if (isExplained != wasExplained) writeAll()
    }

    private fun touch(one: Int, other: Int): Boolean {
        val columns = abs(one % grid.columns - other % grid.columns)
        val rows = abs(one / grid.columns - other / grid.columns)
        return columns <= 1 && rows <= 1
    }

    /** Writes what is believed of the cell with [slot] into the map. */
    private fun write(slot: Int) {
        val active = choice.active
        val value = middle + scale * active.truth(slot)
        val reach = scale * quantile(active) * sqrt(active.variance())
        val lean = scale * active.lean()
        var lower = minOf(value, value + lean - reach)
        var upper = maxOf(value, value + lean + reach)
        val rival = choice.rival
        if (rival != null) {
            // Where two models are possible the bounds hold what either says.
            val other = middle + scale * rival.truth(slot)
            val otherReach = scale * quantile(rival) * sqrt(rival.variance())
            val otherLean = scale * rival.lean()
            lower = minOf(lower, other, other + otherLean - otherReach)
            upper = maxOf(upper, other, other + otherLean + otherReach)
        }
        // What is not a number came of numbers too large to square: the cell keeps what it had.
        if (!lower.isFinite() || !upper.isFinite()) return
        val cell = visited[slot]
        val prior = written.prior
        if (!isExplained) {
            fallback.bring(cell)
            val kept = if (fallback.isPreferred) fallback.map.value(cell) else value.coerceIn(prior.lower, prior.upper)
            // Such bounds know nothing of water that changes in a cell, but its readings show some of it.
            val more = if (choice.areCellsEven && choice.isWaterSteady) 0.0 else SPREAD * fallback.spread(cell)
            written.setValue(cell, kept)
            written.setBounds(
                cell,
                minOf(maxOf(prior.lower, kept - more), fallback.map.lower(cell), kept),
                maxOf(minOf(prior.upper, kept + more), fallback.map.upper(cell), kept),
            )
        } else if (upper < prior.lower || lower > prior.upper) {
            written.setValue(cell, value)
            written.setBounds(cell, lower, upper)
        } else {
            written.setValue(cell, value.coerceIn(prior.lower, prior.upper))
            written.setBounds(cell, maxOf(prior.lower, lower), minOf(prior.upper, upper))
        }
    }

    private fun quantile(fit: SensorFit) = SensorChoice.quantile(fit.freedom)

    public companion object {
        /**
         * Cells whose value and bounds are brought up to date each time the boat moves on, besides the last two: one for each
         * reading of the stay, but no more than these once not all readings are kept.
         */
        public const val REFRESHED: Int = 4

        /** Largest distance of a usable reading from the prior's middle, in widths of the prior. */
        public const val FARTHEST: Double = 100.0

        /** [work] of an estimator that has always learned from all its readings. */
        public const val AT_ONCE: Double = Double.POSITIVE_INFINITY

        /** [work] of some 0.4 ms on a desk's core. */
        public const val AFLOAT: Double = 16_000.0
        private const val FIRST_CELLS = 128

        /** Half the widest interval of a cell that is known well, widths of the prior. */
        private const val WELL_KNOWN = 0.125

        /** Standard deviations of a cell's readings that the bounds reach where cells are not even or their water changes. */
        private const val SPREAD = 2.0
    }
}
