package stillwater.io

import stillwater.model.Conditions

/**
 * A row of a log that waits for the times after it.
 *
 * @property line physical line, from 1. @property seconds its time. @property x metres east, NaN without a fix.
 * @property y metres north, likewise. @property value the reading, sensor units. @property conditions the rest.
 */
internal class TimedRow(
    val line: Long,
    val seconds: Double,
    val x: Double,
    val y: Double,
    val value: Double,
    val conditions: Conditions,
) {
    /** The same row with its time at [seconds]. */
    fun at(seconds: Double) = TimedRow(line, seconds, x, y, value, conditions)
}

/** Why a row is refused for its time. */
internal enum class TimeFault(val reason: String) {
    /** It lies before the row before it. */
    BACK("times going back"),

    /** It has the time of the row before it. */
    DUPLICATE("duplicate times"),

    /** It lies after the two rows after it, which go on from the row before it. */
    AHEAD("times ahead of the rows around them"),
}

/**
 * Lets rows through whose times grow, and finds the one to refuse where they do not: a single time stamp in the future
 * must not silence all rows after it.
 *
 * Of a row and the next, which lies before it but after the row before both, the first is refused if the row after them
 * lies between the two, and the second if not.
 *
 * @param most rows that may share one time: 1 unless times are rounded. @param use takes a row in the order of times.
 * @param refuse takes a row that is out of order, the one it lies on the wrong side of, and how.
 */
internal class TimeOrder(
    private val most: Int,
    private val use: (TimedRow) -> Unit,
    private val refuse: (TimedRow, TimedRow, TimeFault) -> Unit,
) {
    private var before = Double.NEGATIVE_INFINITY

    /** Rows let through at that time. */
    private var sharing = 0
    private var latest: TimedRow? = null
    private var challenger: TimedRow? = null
    private val runs = BackwardRuns("rows")

    /** What to say of long runs of refused rows; null where there are none. */
    val note: String? get() = runs.note

    /** Rows let through that have the time of the one before. */
    var shared = 0L
        private set

    /** Takes the next row of the file. */
    fun take(row: TimedRow) {
        val held = latest
        val second = challenger
        when {
            held == null -> latest = row
            row.seconds == held.seconds && !mayShare(held) -> refuse(row, held, TimeFault.DUPLICATE)
            row.seconds >= held.seconds -> {
                if (second != null) back(second, held)
                pass(held, row)
            }
            second != null && (row.seconds > second.seconds || (row.seconds == second.seconds && mayShare(second))) -> {
                refuse(held, second, TimeFault.AHEAD)
                pass(second, row)
            }
            second == null && isAfterThose(row) -> challenger = row
            // Both lie before the one that waits, and this one before the other: the first of them is told first.
            second != null && row.seconds < second.seconds && isAfterThose(row) -> {
                back(second, held)
                challenger = row
            }
            else -> back(row, held)
        }
    }

    /** Decides on the rows that still wait, after the last. */
    fun end() {
        val held = latest ?: return
        challenger?.let { back(it, held) }
        pass(held, null)
    }

    /** Whether one more may have the time of [row], which waits. */
    private fun mayShare(row: TimedRow) = 1 + (if (row.seconds == before) sharing else 0) < most

    /** Whether [row] may follow the rows let through. */
    private fun isAfterThose(row: TimedRow) = row.seconds > before || (row.seconds == before && sharing < most)

    private fun back(row: TimedRow, held: TimedRow) {
        runs.refused(held.line)
        refuse(row, held, TimeFault.BACK)
    }

    private fun pass(row: TimedRow, next: TimedRow?) {
        use(row)
        if (row.seconds == before) {
            sharing++
            shared++
        } else {
            sharing = 1
        }
        before = row.seconds
        latest = next
        challenger = null
        runs.accepted()
    }
}

/** Remembers the longest run of [things] (rows, lines) that were refused because their times lie before one of them. */
internal class BackwardRuns(private val things: String) {
    private var run = 0L
    private var longest = 0L
    private var lineOfLongest = 0L

    /** What to say of the longest run; null where it is no longer than a jitter of threads or clocks may make it. */
    val note: String?
        get() = if (longest < LONG) {
            null
        } else {
            "$longest $things in a row after line $lineOfLongest lie before its time and were left out: the clock " +
                "was set back there, or the time in that line is wrong"
        }

    /** Another one is refused; [line] has the time that it lies before. */
    fun refused(line: Long) {
        if (++run <= longest) return
        longest = run
        lineOfLongest = line
    }

    /** One is in order. */
    fun accepted() {
        run = 0
    }

    private companion object {
        const val LONG = 10
    }
}
