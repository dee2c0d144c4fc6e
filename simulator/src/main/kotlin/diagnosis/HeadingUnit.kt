package stillwater.diagnosis

import kotlin.math.PI
import kotlin.math.abs

/**
 * Whether a column's headings are degrees or radians: what its name says (`heading_deg`, `yaw (°)`, `heading_rad`), and
 * where it says nothing, degrees if any heading is beyond a full turn of radians.
 *
 * From where and which way round they count does not matter: what depends on a heading is sought as a sum of the sines
 * and cosines of it and of its double, and those of another custom are of the same span.
 *
 * @param column the column's name. @param headings as logged, NaN where there is none. Not modified.
 */
internal class HeadingUnit(private val column: String, headings: DoubleArray) {
    private val words = column.split(WORDS).map { it.lowercase() }
    private val isNamedDegrees = words.any { it in DEGREES } || '°' in column
    private val isNamed = isNamedDegrees || words.any { it in RADIANS }
    private val isBeyondATurn = headings.any { abs(it) > FULL_TURN }

    /** Whether they are degrees. */
    val inDegrees: Boolean = if (isNamed) isNamedDegrees else isBeyondATurn

    /** What they were taken for, and why, in a sentence. */
    val sentence: String
        get() {
            val why = when {
                isNamed -> "as the column's name says"
                inDegrees -> "for some are beyond 6.28, a full turn of radians"
                else -> "for none is beyond 6.28, a full turn; a column named ${column}_deg would be taken as degrees"
            }
            return "The headings in $column were taken as ${if (inDegrees) "degrees" else "radians"}, $why."
        }

    private companion object {
        /** Between words, written apart or as camelCase. */
        val WORDS = Regex("""[^\p{L}]+|(?<=\p{Ll})(?=\p{Lu})""")
        val DEGREES = setOf("deg", "degree", "degrees")
        val RADIANS = setOf("rad", "radian", "radians")

        /** Rounded up: some loggers give whole turns with two digits. */
        const val FULL_TURN = 2 * PI + 0.005
    }
}
