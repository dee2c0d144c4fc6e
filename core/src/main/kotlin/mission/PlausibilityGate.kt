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

    /** It passes, and the one held before it with it. */
    CONFIRMED,

    /** It is outside of what the water can have. */
    OUT_OF_RANGE,

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
 * A reading outside [range] is dropped. One that differs from the reading before by more than [largestJump] is held until
 * the next: if that agrees with it, both pass, else the held one was alone and is dropped. Every reading is counted under
 * what became of it. Never throws on data. Confined to one thread.
 *
 * @property range what the water can have, sensor units.
 * @property largestJump from one reading to the next that needs no confirmation, sensor units, above 0; may be infinite.
 * @param sink where readings go that pass, in order. Retained.
 * @throws IllegalArgumentException if [largestJump] is not above 0.
 */
public class PlausibilityGate(
    public val range: Interval,
    public val largestJump: Double,
    private val sink: ReadingSink,
) {
    init {
        require(largestJump > 0) { "largestJump ($largestJump sensor units) must be above 0" }
    }

    private var last = Double.NaN

    /** The reading that waits for the next; null where none does. */
    public var held: Reading? = null
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
    public val leftOut: Long get() = outOfRange + lone + withoutValueOrPlace

    /** Judges [reading] and hands on what passes. */
    public fun take(reading: Reading): ReadingVerdict {
        val place = reading.position
        val isWhole = reading.value.isFinite() && place.x.isFinite() && place.y.isFinite()
        if (!isWhole || !reading.time.seconds.isFinite()) return lacksPlace()
        if (reading.value !in range) {
            outOfRange++
            return ReadingVerdict.OUT_OF_RANGE
        }
        val waiting = held
        if (waiting != null && abs(reading.value - waiting.value) <= largestJump) {
            pass(waiting)
            pass(reading)
            return ReadingVerdict.CONFIRMED
        }
        if (waiting != null) lone++
        if (last.isNaN() || abs(reading.value - last) <= largestJump) {
            pass(reading)
            return ReadingVerdict.PASSED
        }
        held = reading
        return ReadingVerdict.HELD
    }

    /** Counts a reading whose place is not known. */
    public fun lacksPlace(): ReadingVerdict {
        withoutValueOrPlace++
        return ReadingVerdict.WITHOUT_VALUE_OR_PLACE
    }

    /** Goes on after a restart: [last] is the value that passed last, NaN where none did, and [held] what waited. */
    public fun resume(last: Double, held: Reading?) {
        this.last = last
        this.held = held
    }

    private fun pass(reading: Reading) {
        held = null
        last = reading.value
        passed++
        sink.take(reading)
    }
}
