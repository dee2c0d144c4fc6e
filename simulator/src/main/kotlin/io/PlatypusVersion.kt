package stillwater.io

/**
 * The three log formats of the Platypus boats.
 *
 * @property release version of the app that wrote it.
 */
internal enum class PlatypusVersion(val release: String, private val line: Regex) {
    /** `<ms> HH:MM:SS,m KEY: text`. */
    TEXT("4.0.0", Regex("""\d+ \d{1,2}:\d{1,2}:\d{1,2},\d{1,3} [A-Za-z][A-Za-z0-9_ ]*: .*""")),

    /** `<ms> HH:MM:SS,m {json}`. */
    CLOCK_JSON("4.1.0", Regex("""\d+ \d{1,2}:\d{1,2}:\d{1,2},\d{1,3} \{.*""")),

    /** `<ms>` tab `<level>` tab `{json}`. */
    LEVEL_JSON("4.2.0", Regex("""\d+\t[DIWEF]\t\{.*""")),
    ;

    companion object {
        private const val LINES_LOOKED_AT = 100

        /** The version that the first readable line of [head] is written in, or null where none is. */
        fun of(head: List<String>): PlatypusVersion? = head.take(LINES_LOOKED_AT).firstNotNullOfOrNull { line ->
            entries.firstOrNull { it.line.matches(line) }
        }
    }
}
