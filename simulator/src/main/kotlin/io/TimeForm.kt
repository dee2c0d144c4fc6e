package stillwater.io

/**
 * How a log writes its times, where they are neither seconds nor ISO 8601 alone.
 *
 * @property kind what the column with the time holds. @property factor seconds in one of its units, of
 * [Kind.NUMBER]. @property zero seconds since 1970 where its numbers are 0, likewise. @property order of dates in
 * numbers, or null where there are none. @property overnight least step back, s, that begins the next day, of
 * [Kind.OF_ANY_DAY]; null for one from the last quarter of a day to the first. @property isZoned whether times in
 * ISO 8601 have an offset, or Z, as the first has; null where it is none.
 */
internal class TimeForm(
    val kind: Kind,
    val factor: Double = 1.0,
    val zero: Double = 0.0,
    val order: DateOrder? = null,
    val overnight: Double? = null,
    val isZoned: Boolean? = null,
) {
    /** What a column with the time may hold. */
    enum class Kind {
        /** Seconds or ISO 8601. */
        PLAIN,

        /** Numbers in another unit than seconds, or from another zero. */
        NUMBER,

        /** Dates with times of day. */
        DATE,

        /** Times of day, with the date in another column. */
        OF_DAY,

        /** Times of day without a date. */
        OF_ANY_DAY,
    }

    /** Reads the times of one pass through a log, in its order: times of day alone need those before them. */
    inner class Clock {
        private var last = Double.NaN
        private var beforeLast = Double.NaN
        private var beforeMidnight = Double.POSITIVE_INFINITY

        /** Midnights that times of day alone have passed. */
        var midnights = 0
            private set

        /** Seconds from the time before the last of these midnights to the one after it. */
        var night = 0.0
            private set

        /** Seconds of [text], of which [number] is the number or NaN; NaN where it is no time. */
        fun seconds(text: String, number: Double): Double = when (kind) {
            Kind.PLAIN -> if (number.isNaN()) IsoTime.seconds(text, isZoned) else number
            Kind.NUMBER -> number * factor + zero
            Kind.DATE -> DateText.seconds(text, order)
            Kind.OF_DAY -> DateText.ofDay(text)
            Kind.OF_ANY_DAY -> ofAnyDay(DateText.ofDay(text))
        }

        /** Seconds since 1970 at the beginning of the day [text], of which [number] is the number or NaN. */
        fun day(text: String, number: Double): Double {
            if (number in ExcelDays.RANGE) return ExcelDays.seconds(kotlin.math.floor(number))
            val parts = DateText.parts(text) ?: return Double.NaN
            // Some programs write midnight after every date.
            return if (parts.rest.isBlank() || DateText.ofDay(parts.rest) == 0.0) parts.day(order) else Double.NaN
        }

        /**
         * One wrong stamp must not move all rows after it by a day, nor hide: a time that the rows around it contradict
         * stays where the order of times is seen to be broken.
         */
        private fun ofAnyDay(seconds: Double): Double {
            if (seconds.isNaN()) return seconds
            if (isNextDay(seconds) && !(seconds > beforeLast)) {
                midnights++
                night = DAY + seconds - last
                beforeMidnight = last
            } else if (seconds - last > HALF_A_DAY && seconds >= beforeMidnight) {
                // The time before it was none of a next day.
                midnights--
                beforeMidnight = Double.POSITIVE_INFINITY
            }
            if (seconds != last) beforeLast = last
            last = seconds
            return midnights * DAY + seconds
        }

        private fun isNextDay(seconds: Double) =
            if (overnight == null) last >= EVENING && seconds <= MORNING else last - seconds >= overnight
    }

    private companion object {
        const val DAY = 86_400.0
        const val HALF_A_DAY = 43_200.0
        const val EVENING = 64_800.0
        const val MORNING = 21_600.0
    }
}

/** Days as spreadsheets count them, from 30 December 1899. */
internal object ExcelDays {
    private const val UNIX_ZERO = 25_569.0

    /** Days from 1954 to 2118: what a number must be in to be taken for one. */
    val RANGE = 20_000.0..80_000.0

    /** Seconds in a day. */
    const val FACTOR = 86_400.0

    /** Seconds since 1970 of day 0. */
    const val ZERO = -UNIX_ZERO * FACTOR

    /** Seconds since 1970 of [days]. */
    fun seconds(days: Double): Double = days * FACTOR + ZERO
}
