package stillwater.report

import de.siegmar.fastcsv.writer.CsvWriter
import de.siegmar.fastcsv.writer.LineDelimiter
import java.io.OutputStream
import java.io.OutputStreamWriter

/**
 * Writes a table for machines: RFC 4180 CSV in UTF-8, lines ending in `\n`, the same bytes in every locale.
 *
 * Numbers are written so that reading them gives the same double (`0.1`, `100.0`, `1.0E-7`), not always in the fewest
 * digits before Java 19; a missing value is an empty field. Confined to one thread; closing it closes the stream.
 *
 * @param out where the text goes, buffered by the caller. Closed with this.
 * @param header the columns' names, with the units in them, such as `mean_abs_error`.
 */
public class CsvTable(out: OutputStream, private val header: List<String>) : AutoCloseable {
    private val writer = CsvWriter.builder().lineDelimiter(
        LineDelimiter.LF,
    ).build(OutputStreamWriter(out, Charsets.UTF_8))
    private val fields = arrayOfNulls<String>(header.size)

    init {
        require(header.isNotEmpty()) { "a CSV table needs at least one column" }
        writer.writeRecord(header)
    }

    /**
     * Writes one row: text as it is, whole numbers and doubles as numbers, NaN and null as an empty field.
     *
     * @throws IllegalArgumentException if there are not as many [values] as columns.
     */
    public fun row(vararg values: Any?) {
        require(values.size == header.size) { "a row has ${values.size} fields, the table ${header.size} columns" }
        for (i in values.indices) fields[i] = text(values[i])
        writer.writeRecord(*fields)
    }

    override fun close() {
        writer.close()
    }

    private fun text(value: Any?): String? = when (value) {
        null -> null
        is Double -> if (value.isNaN()) null else value.toString()
        else -> value.toString()
    }
}
