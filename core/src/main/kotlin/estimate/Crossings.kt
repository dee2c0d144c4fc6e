package stillwater.estimate

import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.hypot

/**
 * When a boat crossed from cell to cell, for readings whose places are known to some error only.
 *
 * A reading so near to a border that it may be of the next cell tells of neither: it is passed over. The time from the last
 * reading that is surely of one cell to the first that is surely of another was spent in both. Where places are known much better
 * than the boat goes between two readings, they tell when it crossed the border between the two, [from] at the
 * earliest and [until] at the latest. Elsewhere nobody knows how long it was in each: that time counts as spent in water of
 * its own that is not mapped ([water]), so that the sensor's state goes on from there and no cell's value suffers. What
 * it costs is that reading. Where stays are so short that little is left of them, readings are taken at their word.
 * Readings that say nothing of their place's error are, too.
 *
 * Source: core/docs/SelfCalibratingEstimator.md, section "Where the boat was". Confined to one thread.
 */
internal class Crossings {
    private var last = LagBank.NONE
    private var isBetween = false
    private var lastSeconds = Double.NaN
    private var lastAlong = Double.NaN
    private var lastAcross = Double.NaN

    /** Readings since the last that counted, this one included. */
    private var steps = 0

    /** Whether there was a pause among them, in which the boat may have gone any way. */
    private var hasPaused = false

    /** The last reading of all, and how long after the one before it came, s; NaN where there was none. */
    private var latestSeconds = Double.NaN
    private var step = Double.NaN

    /** Whether borders are treated so; where not, every reading is of the cell it is believed to be in. */
    var areHeeded: Boolean = false

    /** Whether the reading is the first in its cell, and when the boat came there is known. */
    var isTimed: Boolean = false
        private set

    /** When it crossed at the earliest, s, where that is known. */
    var from: Double = Double.NaN
        private set

    /** When it crossed at the latest, s, where that is known. */
    var until: Double = Double.NaN
        private set

    /** The boat left without a reading of where it went. */
    fun leave() {
        last = LagBank.NONE
        isBetween = false
        isTimed = false
        steps = 0
        hasPaused = false
        latestSeconds = Double.NaN
        step = Double.NaN
    }

    /** What the reading at [seconds] in the cell with [slot], taken at [place], counts for: below 0 for no cell. */
    fun slot(slot: Int, seconds: Double, place: Place): Int {
        isTimed = false
        if (!place.isKnown) {
            if (!latestSeconds.isNaN()) leave()
            last = slot
            return slot
        }
        val longest = PAUSE * step
        step = seconds - latestSeconds
        latestSeconds = seconds
        steps++
        if (!(step <= longest)) hasPaused = true
        if (areHeeded && place.isNearBorder) {
            isBetween = last != LagBank.NONE
            return PASSED_OVER
        }
        val crosses = last != LagBank.NONE && last != slot
        isTimed = crosses && !hasPaused && steps <= MOST_STEPS && time(seconds, place)
        val isUnknown = areHeeded && !isTimed && (isBetween || crosses)
        last = slot
        isBetween = false
        lastSeconds = seconds
        lastAlong = place.along
        lastAcross = place.across
        steps = 0
        hasPaused = false
        return if (isUnknown) water(slot) else slot
    }

    /**
     * When the boat crossed the borders between the last reading and the one at [seconds] on a straight way at an even
     * speed. False where places are not known well enough to tell.
     */
    private fun time(seconds: Double, place: Place): Boolean {
        val along = place.along - lastAlong
        val across = place.across - lastAcross
        // A way that is long by the errors of its ends only would be taken for one that is known well.
        val way = hypot(along, across) - REACH * place.deviation
        if (!(place.deviation * steps <= CLEAR * way)) return false
        from = Double.POSITIVE_INFINITY
        until = Double.NEGATIVE_INFINITY
        val elapsed = seconds - lastSeconds
        cross(lastAlong, along, place.width, elapsed, place.deviation)
        cross(lastAcross, across, place.height, elapsed, place.deviation)
        from = maxOf(from, lastSeconds)
        until = minOf(until, seconds)
        return from <= until
    }

    /** Takes the border between [start] and a place [way] from it, if there is one between cells of [size] m. */
    private fun cross(start: Double, way: Double, size: Double, elapsed: Double, deviation: Double) {
        val cell = floor(start / size)
        val other = floor((start + way) / size)
        if (cell == other) return
        val border = maxOf(cell, other) * size
        val middle = lastSeconds + (border - start) / way * elapsed
        val reach = if (areHeeded) REACH * deviation / abs(way) * elapsed else 0.0
        from = minOf(from, middle - reach)
        until = maxOf(until, middle + reach)
    }

    companion object {
        /** Stands for a cell where a reading is not to be taken. */
        const val PASSED_OVER = Int.MIN_VALUE

        /** A step more than so many times as long as the one before is a pause. */
        private const val PAUSE = 2.5

        /** Readings from the last that counted to the next, at most, over which a way is taken for straight. */
        private const val MOST_STEPS = 3

        /** Deviation of places over the least way of one step, at most, with which they tell when a border was crossed. */
        private const val CLEAR = 0.25

        /** Deviations of places that the time of a crossing allows for. */
        private const val REACH = 2.0

        /** Stands for the cell with the water on the way into the cell with [slot]; never the same twice in a row. */
        private fun water(slot: Int) = LagBank.NONE - 1 - slot
    }
}
