package stillwater.estimate

import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * Maps the field through a slow sensor and learns on the way how slow it is.
 *
 * Model: τ ṡ = ψ − s with s going on over cell borders, z = s + e, e independent with variance σ². τ, σ and every cell's
 * ψ are unknown; τ is believed beforehand as [SelfCalibratingSettings] say. A cell's value is its truth at the most
 * likely τ; its bounds are credible at 95 %, the uncertainty of τ and σ included, and cut to the prior. What a visit
 * says of its cell rests on the readings there, on the sensor's state on entering and on the readings in the cell after;
 * visits of one cell are pooled. A cell never visited keeps the prior.
 *
 * Assumes the field constant within a cell and in time, and that the interval between two readings in different cells is
 * spent in the second: sample often on a border. Between cells that do not touch, or after leaving the grid or a reading
 * without a value in another cell, the sensor's state is taken as unknown. A reading farther than [FARTHEST] widths of
 * the prior from its middle is not used and counts as a conflict. With an asymmetric or second-order response or a dead
 * time values are biased; once the readings show that, [isExplained] says so and bounds go back to the prior's.
 *
 * Source: own result, core/docs/SelfCalibratingEstimator.md; sums of innovations as in Schweppe 1965,
 * doi:10.1109/TIT.1965.1053737. The first [SelfCalibratingSettings.recalled] readings are kept and gone through again
 * each time their number doubles, so a reading is O(1) on average and at worst O(recalled); no call allocates once the
 * cells' memory has grown. A new time constant changes all cells: the map follows [REFRESHED] cells a reading. Confined
 * to one thread.
 *
 * @param grid the cells.
 * @param prior the range of the field: a cell's value before it is measured has its midpoint, and, for what is computed,
 *   its width as standard deviation; sensor units.
 * @property settings what is believed of the sensor beforehand.
 */
public class SelfCalibratingEstimator(
    private val grid: Grid,
    prior: Interval,
    public val settings: SelfCalibratingSettings = SelfCalibratingSettings(),
) : CellEstimator(grid, prior) {
    private val middle = prior.midpoint
    private val scale = if (prior.width > 0 && prior.width.isFinite()) prior.width else 1.0
    private val bank = LagBank()
    private val mean = settings.mean
    private val priorInformation = 1 / (settings.spread * settings.spread)

    private val tape = ReadingTape(settings.recalled)
    private var nextReplay = FIRST_REPLAY
    private val slots = IntArray(grid.size) { LagBank.NONE }
    private var visited = IntArray(FIRST_CELLS)
    private var visitedCount = 0
    private var refreshed = 0
    private var lastCell = Grid.OUTSIDE

    /** σ², scaled. */
    private var noiseVariance = FIRST_NOISE * FIRST_NOISE

    /** θ̂ − θ of the bank's middle. */
    private var offset = 0.0

    /** Inverse variance of θ̂. */
    private var information = priorInformation

    init {
        bank.reset(mean, WIDEST_STEP, noiseVariance)
    }

    /** The most likely time constant τ, s. */
    public val timeConstant: Double get() = exp(bank.node + offset)

    /**
     * Whether a first-order sensor explains the readings: successive innovations are not clearly alike. Where it does
     * not, values are the best that such a sensor gives and the map's bounds are the prior's. True until there is
     * evidence against it.
     */
    public var isExplained: Boolean = true
        private set

    /** Standard deviation of ln τ: the relative uncertainty of [timeConstant], dimensionless. */
    public val relativeUncertainty: Double get() = 1 / sqrt(information)

    /** Standard deviation σ of the readings about the sensor's state, noise and resolution together, sensor units. */
    public val noise: Double get() = scale * sqrt(noiseVariance)

    /** Where τ lies with a probability of 95 %, s. Allocates. */
    public fun timeConstantInterval(): Interval {
        val spread = quantile() * relativeUncertainty
        return Interval(exp(bank.node + offset - spread), exp(bank.node + offset + spread))
    }

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        val scaled = (value - middle) / scale
        if (!(abs(scaled) <= FARTHEST)) {
            map.countConflict(cell)
            if (cell != lastCell) leave()
            return
        }
        if (cell != lastCell) enter(cell)
        val slot = slots[cell]
        tape.add(slot, seconds, scaled)
        bank.take(slot, seconds, scaled)
        if (tape.isComplete && tape.size >= nextReplay) {
            while (nextReplay <= tape.size) nextReplay *= 2
            calibrate()
            for (i in 0 until visitedCount) write(i)
            return
        }
        learn()
        write(slot)
        if (bank.previous != LagBank.NONE) write(bank.previous)
        repeat(REFRESHED) {
            if (++refreshed >= visitedCount) refreshed = 0
            write(refreshed)
        }
    }

    private fun enter(cell: Int) {
        if (lastCell != Grid.OUTSIDE && !touch(lastCell, cell)) leave()
        lastCell = cell
        if (slots[cell] == LagBank.NONE) {
            if (visitedCount == visited.size) visited = visited.copyOf(minOf(2 * visitedCount, grid.size))
            visited[visitedCount] = cell
            slots[cell] = visitedCount++
        }
        // Beyond the tape the nodes follow the time constant; up to its end they start over.
        if (!tape.isComplete && abs(offset) > bank.step / 2) bank.move(offset.coerceIn(-bank.step, bank.step))
    }

    override fun leave() {
        if (lastCell == Grid.OUTSIDE) return
        lastCell = Grid.OUTSIDE
        bank.leave()
        tape.add(LagBank.NONE, 0.0, 0.0)
    }

    private fun touch(one: Int, other: Int): Boolean {
        val columns = abs(one % grid.columns - other % grid.columns)
        val rows = abs(one / grid.columns - other / grid.columns)
        return columns <= 1 && rows <= 1
    }

    /** Starts over with the time constant that explains the tape best: a coarse search, then Newton's steps. */
    private fun calibrate() {
        var best = bank.node
        var least = Double.POSITIVE_INFINITY
        val reach = ceil(SEARCHED * settings.spread / (3 * WIDEST_STEP)).toInt()
        for (k in -reach..reach) {
            play(mean + 3 * k * WIDEST_STEP, WIDEST_STEP)
            for (i in 0..2) {
                val node = bank.node + (i - 1) * bank.step
                val cost = bank.misfit(i) / noiseVariance + (node - mean) * (node - mean) * priorInformation
                if (cost < least) {
                    least = cost
                    best = node
                }
            }
        }
        var step = WIDEST_STEP
        repeat(MOST_ROUNDS) {
            play(best, step)
            learn()
            val wanted = (2 * relativeUncertainty).coerceIn(NARROWEST_STEP, WIDEST_STEP)
            val change = offset.coerceIn(-step, step)
            if (abs(change) <= 0.1 * relativeUncertainty && step <= 2 * wanted) return
            best += change
            step = abs(change).coerceIn(wanted, WIDEST_STEP)
        }
        play(best, step)
        learn()
    }

    private fun play(node: Double, step: Double) {
        bank.reset(node, step, noiseVariance)
        tape.play(bank)
    }

    /** Reads time constant and noise off the bank's parabola, eqs. (9) to (11). */
    private fun learn() {
        val curvature = maxOf(0.0, bank.curvature())
        val slope = bank.slope() / noiseVariance + (mean - bank.node) * priorInformation
        information = curvature / noiseVariance + priorInformation
        offset = (slope / information).coerceIn(-FARTHEST_OFFSET * bank.step, FARTHEST_OFFSET * bank.step)
        val place = offset / bank.step
        val misfit = LagBank.interpolate(bank.misfit(0), bank.misfit(1), bank.misfit(2), place)
        val sum = maxOf(0.0, misfit) + FIRST_FREEDOM * FIRST_NOISE * FIRST_NOISE
        val freedom = FIRST_FREEDOM + maxOf(0.0, bank.freedom)
        noiseVariance = sum / freedom
        // The correlation of white noise has the standard deviation 1/√freedom, eq. (13).
        val correlation = bank.succession / sum
        isExplained = freedom < FEWEST_TO_JUDGE || correlation <= LEAST_CORRELATION + DEVIATIONS / sqrt(freedom)
    }

    /** Writes what is believed of the cell with [slot] into the map, eq. (12). */
    private fun write(slot: Int) {
        val low = bank.truth(slot, 0)
        val high = bank.truth(slot, 2)
        val there = bank.truth(slot, 1)
        val place = offset / bank.step
        val scaled = LagBank.interpolate(low, there, high, place)
        val byTheta = ((high - low) / 2 + place * (high - 2 * there + low)) / bank.step
        val variance = noiseVariance / bank.information(slot, 1) + byTheta * byTheta / information
        val value = middle + scale * scaled
        val reach = scale * quantile() * sqrt(variance)
        // What is not a number came of numbers too large to square: the cell keeps what it had.
        if (!(value - reach).isFinite() || !(value + reach).isFinite()) return
        val cell = visited[slot]
        val prior = map.prior
        if (!isExplained) {
            map.setValue(cell, value.coerceIn(prior.lower, prior.upper))
            map.setBounds(cell, prior.lower, prior.upper)
        } else if (value + reach < prior.lower || value - reach > prior.upper) {
            map.setValue(cell, value)
            map.setBounds(cell, value - reach, value + reach)
        } else {
            map.setValue(cell, value.coerceIn(prior.lower, prior.upper))
            map.setBounds(cell, maxOf(prior.lower, value - reach), minOf(prior.upper, value + reach))
        }
    }

    /** Student's 97.5 % quantile to first order in 1/ν: z + (z³ + z) / (4 ν). */
    private fun quantile() = NORMAL + NORMAL * (NORMAL * NORMAL + 1) / (4 * (FIRST_FREEDOM + maxOf(0.0, bank.freedom)))

    public companion object {
        /** Cells whose value and bounds are brought up to date with each reading, besides the last two. */
        public const val REFRESHED: Int = 4

        /** Largest distance of a usable reading from the prior's middle, in widths of the prior. */
        public const val FARTHEST: Double = 100.0

        private const val FIRST_CELLS = 128
        private const val FIRST_REPLAY = 16

        /** What is believed of σ beforehand, in widths of the prior, and how many readings that is worth. */
        private const val FIRST_NOISE = 1e-3
        private const val FIRST_FREEDOM = 2.0

        /** The search reaches so many standard deviations of the belief about ln τ either way. */
        private const val SEARCHED = 1.5

        /** Distances of the bank's nodes: a parabola is good over the widest, and numbers over the narrowest. */
        private const val WIDEST_STEP = 0.15
        private const val NARROWEST_STEP = 1e-3
        private const val FARTHEST_OFFSET = 2.0
        private const val MOST_ROUNDS = 8

        /** Correlation of successive innovations that speaks against the model: this much and so many deviations. */
        private const val LEAST_CORRELATION = 0.02
        private const val DEVIATIONS = 4.5
        private const val FEWEST_TO_JUDGE = 64

        /** 97.5 % quantile of the normal distribution. */
        private const val NORMAL = 1.959963984540054
    }
}
