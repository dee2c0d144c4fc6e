package stillwater.estimate

import stillwater.model.Grid

/**
 * What a [SelfCalibratingEstimator] has learned of its sensor: keeps the first readings and fits the models to all of
 * them each time their number has grown by half, at once or a part with each reading.
 *
 * While a fit is under way its readings are those there were when it began, and what was learned before holds. Once it
 * is complete it takes the readings that came since, and then holds instead. It is complete, at the latest, when there
 * is no room for another reading: what is left then is done at once. Parts are counted in steps, not in time, so that
 * the same readings give the same results again.
 *
 * @param work most filters' steps to be taken for a reading, without end for a fit at once. @param grid the cells.
 */
internal class SensorLearner(settings: SelfCalibratingSettings, private val work: Double, grid: Grid) {
    private val tape = ReadingTape(settings.recalled, grid.cellWidth, grid.cellHeight)
    private val parts = Parts()
    private val plain = Pair(settings, heedsBorders = false)

    /** The same with borders heeded: each has its own history, since a fit begins where its last one ended. */
    private val heeding by lazy(LazyThreadSafetyMode.NONE) { Pair(settings, heedsBorders = true) }
    private var nextFit = FIRST_FIT

    /** How many readings and interruptions the last fit was of. */
    private var fitted = 0

    /** What holds. */
    var choice: SensorChoice = plain.latest
        private set

    /** Whether the models are fitted to all there was. */
    val isComplete: Boolean get() = tape.isComplete

    /** Mean time spent in a cell at a stretch, s. */
    fun meanStay(): Double = tape.meanStay()

    /** Keeps a reading or interruption, see [ReadingTape.add]. Answers whether another fit holds from now on. */
    fun add(slot: Int, seconds: Double, value: Double, place: Place? = null): Boolean {
        val isLast = parts.isBusy && !tape.hasRoom
        if (isLast) {
            parts.go(Double.POSITIVE_INFINITY)
            // One that was due meanwhile, too: it is the last chance.
            learn(Double.POSITIVE_INFINITY)
        }
        tape.add(slot, seconds, value, place)
        return isLast
    }

    /** Fits what is due, or a part of it. Answers whether another fit, of all readings, holds from now on. */
    fun learn(): Boolean = learn(work)

    /**
     * Completes the fit under way and fits to all there are, where all are kept and some came since the last fit. Answers
     * whether another fit holds from now on.
     */
    fun learnFromAll(): Boolean {
        val wasBusy = parts.isBusy
        if (wasBusy) parts.go(Double.POSITIVE_INFINITY)
        if (!tape.isComplete || tape.size == fitted) return wasBusy
        parts.begin { decide() }
        parts.go(Double.POSITIVE_INFINITY)
        return true
    }

    private fun learn(most: Double): Boolean {
        if (!parts.isBusy) {
            if (!tape.isComplete || tape.size < nextFit) return false
            while (nextFit <= tape.size) nextFit += nextFit / 2
            parts.begin { decide() }
        }
        parts.go(most)
        return !parts.isBusy
    }

    /**
     * Chooses and fits the sensor's model anew, and whether borders are heeded. In water that changes evenly within a
     * cell a stay looks the same as one with a slow sensor; what happens at borders tells them apart. Heeding them hides
     * that, and the sensor seems slower than it is; where cells are even it takes readings of the wrong cell away, and it
     * does not.
     */
    private suspend fun decide() {
        val size = tape.size
        fitted = size
        val without = plain.begin()
        without.decide(size)
        var chosen = without
        val tellsOfCells = tape.tellsOfPlaces && tape.shareOfStays(FEWEST_SURE, size) >= MOST_STAYS
        if (tellsOfCells) {
            val with = heeding.begin()
            with.decide(size)
            val longest = minOf(LONGER * without.timeConstant, LONGEST * tape.meanStay(size))
            if (with.isExplained && with.timeConstant <= longest) chosen = with
        }
        chosen.catchUp()
        plain.end()
        if (tellsOfCells) heeding.end()
        choice = chosen
    }

    /** The fit that holds, or did last, and the one under way: the same where all is done at once. */
    private inner class Pair(settings: SelfCalibratingSettings, heedsBorders: Boolean) {
        var latest = SensorChoice(settings, Recording(tape, parts, heedsBorders))
            private set
        var next =
            if (work.isInfinite()) latest else SensorChoice(settings, Recording(tape, parts, heedsBorders))

        /** What is to be fitted. */
        fun begin(): SensorChoice {
            latest.settle()
            if (next !== latest) next.becomeLike(latest)
            return next
        }

        /** What was under way holds. */
        fun end() {
            latest = next.also { next = latest }
        }
    }

    private companion object {
        /** Borders are heeded where so large a share of the stays has so many readings that are surely of its cell. */
        const val MOST_STAYS = 0.9
        const val FEWEST_SURE = 2

        /** Time constant over that without borders heeded, and over the mean stay, beyond which they are not. */
        const val LONGER = 1.15
        const val LONGEST = 2.0
        const val FIRST_FIT = 16
    }
}
