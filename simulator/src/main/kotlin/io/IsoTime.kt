package stillwater.io

import java.time.DateTimeException
import java.time.LocalDateTime
import java.time.OffsetDateTime
import java.time.ZoneOffset
import java.time.format.DateTimeFormatter
import java.time.temporal.TemporalAccessor

/** Times as text: ISO 8601, a blank allowed in place of the T; UTC where no offset is given. */
internal object IsoTime {
    private const val SHORTEST = 16
    private const val DATE = 10
    private const val NANOS = 1e-9

    /** Characters of an offset in hours, and in hours and minutes without a colon, both with the sign. */
    private const val HOURS = 3
    private const val MINUTES = 5

    /**
     * The seconds in a time column's field: a number as it stands, or as [seconds]; NaN where it is neither, or where
     * [isZoned] tells whether times have an offset and this one is otherwise.
     */
    fun ofField(text: CharArray, offset: Int, length: Int, isZoned: Boolean? = null): Double {
        val number = DecimalText.parse(text, offset, length)
        return if (number.isNaN()) seconds(String(text, offset, length), isZoned) else number
    }

    /**
     * Seconds since 1970 of [text], or NaN where it is no such time, or where [isZoned] tells whether times have an
     * offset and this one is otherwise.
     */
    fun seconds(text: String, isZoned: Boolean? = null): Double {
        val read = parsed(text) ?: return Double.NaN
        if (isZoned != null && isZoned != read is OffsetDateTime) return Double.NaN
        val time = if (read is LocalDateTime) read.atOffset(ZoneOffset.UTC) else read as OffsetDateTime
        return time.toEpochSecond() + NANOS * time.nano
    }

    /** Whether [text] is such a time with an offset, or Z; null where it is no such time. */
    fun isZoned(text: String): Boolean? = parsed(text)?.let { it is OffsetDateTime }

    private fun parsed(text: String): TemporalAccessor? {
        val trimmed = text.trim()
        if (trimmed.length < SHORTEST || trimmed[4] != '-') return null
        val dated = if (trimmed[DATE] == ' ') trimmed.replaceRange(DATE, DATE + 1, "T") else trimmed
        return try {
            DateTimeFormatter.ISO_DATE_TIME.parseBest(withColon(dated), OffsetDateTime::from, LocalDateTime::from)
        } catch (_: DateTimeException) {
            null
        }
    }

    /** [iso] with an offset written as +0200 or +02 written as +02:00, which alone is read. */
    private fun withColon(iso: String): String {
        val n = iso.length
        return when {
            isSign(iso[n - HOURS]) -> "$iso:00"
            isSign(iso[n - MINUTES]) -> iso.replaceRange(n - 2, n - 2, ":")
            else -> iso
        }
    }

    private fun isSign(c: Char) = c == '+' || c == '-'
}
