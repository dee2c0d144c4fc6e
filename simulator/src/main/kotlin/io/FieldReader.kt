package stillwater.io

/**
 * Reads the fields of a log that is not written plainly: decimal commas, dates, two columns for one time. One for each
 * pass through the log.
 *
 * @param decimalComma whether numbers have a comma for a point. @param form how times are written.
 */
internal class FieldReader(private val decimalComma: Boolean, form: TimeForm) {
    private val clock = form.Clock()
    private val withPoint = CharArray(LONGEST_NUMBER)

    /** Midnights that times of day without a date have passed. */
    val midnights: Int get() = clock.midnights

    /** Seconds from the time before the last of these midnights to the one after it. */
    val night: Double get() = clock.night

    /** The number in [text] at [offset] of [length] characters, or NaN. */
    fun number(text: CharArray, offset: Int, length: Int): Double {
        if (!decimalComma) return DecimalText.parse(text, offset, length)
        if (length > LONGEST_NUMBER) return Double.NaN
        for (i in 0 until length) {
            val c = text[offset + i]
            // Beside decimal commas a point may part thousands: no number to be sure of.
            if (c == '.') return Double.NaN
            withPoint[i] = if (c == ',') '.' else c
        }
        return DecimalText.parse(withPoint, 0, length)
    }

    /** The number in [text], or NaN. */
    fun number(text: String): Double = number(text.toCharArray(), 0, text.length)

    /** Seconds of the time in [text], without the date where that has a column of its own; NaN where it is none. */
    fun time(text: CharArray, offset: Int, length: Int): Double =
        clock.seconds(String(text, offset, length), number(text, offset, length))

    /** Seconds of the time in [text], likewise. */
    fun time(text: String): Double = clock.seconds(text, number(text))

    /** Seconds since 1970 at the beginning of the day in [text], or NaN. */
    fun day(text: CharArray, offset: Int, length: Int): Double =
        clock.day(String(text, offset, length), number(text, offset, length))

    /** Seconds since 1970 at the beginning of the day in [text], or NaN. */
    fun day(text: String): Double = clock.day(text, number(text))

    private companion object {
        const val LONGEST_NUMBER = 64
    }
}
