package stillwater.io

/**
 * The columns of a `.cnv` as Sea-Bird's program Fathom tells them, in remarks that are lines of XML:
 * `#   <Column Number='1' ID='t090C'>`, with the lines `<Name>` and `<Units>` that it may have; seen in files of Fathom 2.1.7.
 */
internal object SeaBirdXml {
    private val COLUMN = Regex("""#\s*<Column Number=['"](\d+)['"] ID=['"]([^'"]*)['"].*""")
    private val NAME = Regex("""#\s*<Name>(.*)</Name>\s*""")
    private val UNITS = Regex("""#\s*<Units>(.*)</Units>\s*""")
    private val BAD_FLAG = Regex("""#\s*<BadFlag>\s*(\S+?)\s*</BadFlag>.*""")
    private val INTERVAL = Regex("""#\s*<Interval Value=['"](\S+?)['"] Units=['"]s['"].*""")

    /** The columns that [lines] tell of, in their order; what else is said there of the table goes to [entries]. */
    fun columns(lines: List<String>, entries: MutableMap<String, String>): List<SeaBirdHeader.Column> {
        val columns = ArrayList<SeaBirdHeader.Column>()
        for (line in lines) {
            COLUMN.matchEntire(line)?.destructured?.let { (number, id) ->
                columns += SeaBirdHeader.Column(number, id, "")
            }
            BAD_FLAG.matchEntire(line)?.let { entries["bad_flag"] = it.groupValues[1] }
            INTERVAL.matchEntire(line)?.let { entries["interval"] = "seconds: ${it.groupValues[1]}" }
            val name = NAME.matchEntire(line)?.groupValues?.get(1)
            val unit = UNITS.matchEntire(line)?.groupValues?.get(1)?.let { "[$it]" }
            val more = name ?: unit ?: continue
            val last = columns.removeLastOrNull() ?: continue
            columns += SeaBirdHeader.Column(last.number, last.name, "${last.longName} $more".trim())
        }
        return columns
    }
}
