package stillwater.io

import de.siegmar.fastcsv.reader.CsvParseException

/** What the CSV parser says, in the words of the log. */
internal object ParserWording {
    /** Characters of the longest field that is read. */
    const val LONGEST_FIELD = 1 shl 20
    private val LINE = Regex("""line (\d+)""")

    /**
     * The problem that [failure] is, in a log whose header of [fields] names is on line [headerLine]; [problem] makes it of
     * a line, of what was expected and of what was found.
     */
    fun of(
        failure: CsvParseException,
        headerLine: Int,
        fields: Int,
        problem: (Long?, String, String) -> LogProblem,
    ): LogProblem {
        val texts = generateSequence<Throwable>(failure) { it.cause }.map { it.message.orEmpty() }.toList()
        val read = texts.firstNotNullOfOrNull { LINE.find(it) }?.groupValues?.get(1)?.toLongOrNull()
        val line = read?.plus(headerLine - 1)
        return when {
            texts.any { "closing quote" in it } -> problem(line, "a separator after a closing quote", "something else")
            texts.any { "fields" in it } -> problem(line, "$fields fields as in the header", "far more")
            else -> problem(line, "fields of at most $LONGEST_FIELD characters", "longer, or an open quote")
        }
    }
}
