package stillwater.mission

import stillwater.model.Interval
import stillwater.model.Reading
import kotlin.math.abs

/** What became of a reading at a [PlausibilityGate]. */
public enum class ReadingVerdict {
    /** It passes. */
    PASSED,

    /** It lies so far from the one before that it waits for the next to confirm it. */
    HELD,

    /** It passes, and the one held before it with it. A reading that is held may confirm the one before, too. */
    CONFIRMED,

    /** It is outside of what the water can have. */
    OUT_OF_RANGE,

    /** It is what the one before it was, to the last digit, or stands alone among such, and waits for how they go on. */
    SAME,

    /** It is one of too many that are the same: the probe is stuck, or its line is. */
    STUCK,

    /** It or its place is not a number, or its place is not known. */
    WITHOUT_VALUE_OR_PLACE,
}

/** Takes a reading that passed. */
public fun interface ReadingSink {
    /** Takes [reading]. */
    public fun take(reading: Reading)
}

/**
 * Keeps back readings that are likelier a digit changed on the wire than water: the lines carry no checksum.
 *
 * A reading outside [range] is dropped. Readings equal to the one before wait for one that is not; where there are
 * [stuckAfter] of them or more, that one included, the probe is taken to be stuck and they are dropped, all but the
 * first, which was true when it was read. One other reading among them, a digit changed on the wire, does not end them:
 * it waits for the next and is dropped with them; once the probe is taken to be stuck any number of such may come. The
 * first, and one that differs from the reading before by more than [largestJump], is held until the next: if it lies
 * between its neighbours, or beyond them by no more than a jump, it passes, else it was alone and is dropped. So a
 * probe that moves fast loses nothing, and a jump of a few deviations of the noise is a good choice. Every reading is
 * counted under what became of it. Never throws on data. Confined to one thread.
 *
 * @property range what the water can have, sensor units.
 * @property largestJump from one reading to the next that needs no confirmation, sensor units, above 0; may be
 *   infinite.
 * @property stuckAfter equal readings in a row that a sound probe does not give, at least 2; null where it may.
 * @param sink where readings go that pass, in order. Retained.
 * @throws IllegalArgumentException if [largestJump] is not above 0 or [stuckAfter] below 2.
 */
public class PlausibilityGate(
    public val range: Interval,
    public val largestJump: Double,
    public val stuckAfter: Int? = null,
    private val sink: ReadingSink,
) {
    init {
        require(largestJump > 0) { "largestJump ($largestJump sensor units) must be above 0" }
        require(stuckAfter == null || stuckAfter >= 2) { "stuckAfter ($stuckAfter readings) must be at least 2" }
    }

    private val equals = ArrayList<Reading>()

    private var last = Double.NaN

    /** The reading that waits for the next; null where none does. */
    public var held: Reading? = null
        private set

    /** Equal readings on end, the one that passed among them, whatever became of the others; 0 before the first. */
    public var run: Int = 0
        private set

    /** Readings equal to the last that passed, and one other among them at most, which wait. Not to be modified. */
    public val same: List<Reading> get() = equals

    /** Readings that wait for a later one. */
    public val waiting: Int get() = equals.size + if (held == null) 0 else 1

    /** Readings of a probe that was stuck. */
    public var stuck: Long = 0
        private set

    /** Readings that passed. */
    public var passed: Long = 0
        private set

    /** Readings outside of the range. */
    public var outOfRange: Long = 0
        private set

    /** Held readings that the next one did not confirm. */
    public var lone: Long = 0
        private set

    /** Readings without a value or a place. */
    public var withoutValueOrPlace: Long = 0
        private set

    /** Readings that were left out. */
    public val leftOut: Long get() = outOfRange + lone + stuck + withoutValueOrPlace

    /** Judges [reading] and hands on what passes. */
    public fun take(reading: Reading): ReadingVerdict {
        val place = reading.position
        val isWhole = reading.value.isFinite() && place.x.isFinite() && place.y.isFinite()
        if (!isWhole || !reading.time.seconds.isFinite()) return lacksPlace()
        if (reading.value !in range) {
            outOfRange++
            return ReadingVerdict.OUT_OF_RANGE
        }
        if (isInterrupted() && reading.value != last) handOnEquals()
        val waiting = held
        held = null
        val isConfirmed = waiting != null && confirms(waiting.value, reading.value)
        if (waiting != null) if (isConfirmed) pass(waiting) else lone++
        // The one just confirmed counts, too.
        if (stuckAfter != null && reading.value == last) return wait(reading, stuckAfter)
        if (abs(reading.value - last) <= largestJump) {
            if (mayInterrupt()) {
                equals.add(reading)
                return ReadingVerdict.SAME
            }
            pass(reading)
            return if (isConfirmed) ReadingVerdict.CONFIRMED else ReadingVerdict.PASSED
        }
        held = reading
        return ReadingVerdict.HELD
    }

    /** Whether [held] lies on the way from the reading before it to [next], or but a jump off it. */
    private fun confirms(held: Double, next: Double): Boolean {
        val before = if (last.isNaN()) next else last
        return held >= minOf(before, next) - largestJump && held <= maxOf(before, next) + largestJump
    }

    /** Counts a reading whose place is not known. */
    public fun lacksPlace(): ReadingVerdict {
        withoutValueOrPlace++
        return ReadingVerdict.WITHOUT_VALUE_OR_PLACE
    }

    /** The boat has left the place: what waits is given up, because later readings of it would come out of order. */
    public fun giveUp() {
        held?.let {
            lone++
            // Or a boat that leaves each cell before the next reading would never have a first one.
            if (last.isNaN()) {
                last = it.value
                run = 1
            }
        }
        held = null
        stuck += equals.size
        equals.clear()
    }

    /**
     * Goes on after a restart: [last] is the value that passed last, NaN where none did, [held] and [same] are what
     * waited, and [run] was as here.
     */
    public fun resume(last: Double, held: Reading?, same: List<Reading> = emptyList(), run: Int = same.size + 1) {
        this.run = run
        equals.clear()
        equals.addAll(same)
        this.last = last
        this.held = held
    }

    private fun wait(reading: Reading, most: Int): ReadingVerdict {
        equals.add(reading)
        if (++run < most) return ReadingVerdict.SAME
        stuck += equals.size
        equals.clear()
        return ReadingVerdict.STUCK
    }

    /** Whether the last reading was another among equal ones. */
    private fun isInterrupted() = equals.isNotEmpty() && equals.last().value != last

    /** Whether another reading may stand among the equal ones now: one until the probe is stuck, and never two on end. */
    private fun mayInterrupt(): Boolean {
        if (stuckAfter == null || run < 2 || isInterrupted()) return false
        return run >= stuckAfter || equals.none { it.value != last }
    }

    private fun pass(reading: Reading) {
        held = null
        handOnEquals()
        handOn(reading)
    }

    private fun handOnEquals() {
        for (i in equals.indices) handOn(equals[i])
        equals.clear()
    }

    private fun handOn(reading: Reading) {
        last = reading.value
        run = 1
        passed++
        sink.take(reading)
    }
}
