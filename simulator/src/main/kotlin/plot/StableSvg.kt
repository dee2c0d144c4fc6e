package stillwater.plot

import java.util.zip.CRC32

/**
 * Makes the plot library's SVG the same for the same data, smaller, scalable and safe to put beside others in a page.
 *
 * Random element ids become ids made from the document's own content, so that two figures inlined in one page do not
 * share any; numbers in attributes keep two decimals (0.01 px); style rules move into the elements that use them, so
 * that they neither leak into a page nor need a renderer that knows selectors; a view box lets a page scale the
 * figure; fonts are those that common systems have.
 */
internal object StableSvg {
    private const val STYLE_BEGIN = "<style type=\"text/css\">"
    private const val STYLE_END = "</style>"
    private const val ID = "id=\""
    private val styleRule = Regex("""(?s)#\w+ \.([\w-]+) \{\s*(.*?)\s*\}""")

    /** Without spaces, which jsvg takes for parts of the names. */
    private const val FONTS = "Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif"

    /**
     * @param drawn the library's document.
     * @param title the accessible name, plain text.
     * @param width drawn width, px.
     * @param height drawn height, px.
     */
    fun of(drawn: String, title: String, width: Int, height: Int): String {
        val body = drawn.substringAfter('>').substringBeforeLast("</svg>")
        val styles = StringBuilder()
        val shapes = CompactSvg(withoutStyles(body, styles), rules(styles.toString())).text()
        val ids = ids(shapes)
        val numbered = ids.foldIndexed(shapes) { n, text, name -> text.replace(name, "$MARK$n$MARK") }
        val prefix = "f" + checksum(title + numbered)
        val stable = ids.indices.fold(numbered) { text, n -> text.replace("$MARK$n$MARK", "$prefix-$n") }
        return buildString(stable.length + SPARE) {
            append("""<svg xmlns="http://www.w3.org/2000/svg" id="$prefix" role="img" """)
            append("""width="$width" height="$height" viewBox="0 0 $width $height" style="font-family:$FONTS">""")
            append("<title>").append(escaped(title)).append("</title>")
            append(stable).append("</svg>\n")
        }
    }

    /** [body] without style elements and the blanks before them; what is in them goes to [styles]. */
    private fun withoutStyles(body: String, styles: StringBuilder): String = buildString(body.length) {
        var from = 0
        while (true) {
            val begin = body.indexOf(STYLE_BEGIN, from)
            val end = if (begin < 0) -1 else body.indexOf(STYLE_END, begin)
            if (end < 0) break
            var blanks = begin
            while (blanks > from && body[blanks - 1].isWhitespace()) blanks--
            append(body, from, blanks)
            styles.append(body, begin + STYLE_BEGIN.length, end)
            from = end + STYLE_END.length
        }
        append(body, from, body.length)
    }

    /** The names of all elements that have one. Not by a pattern, which takes longer than all else here. */
    private fun ids(shapes: String): List<String> = buildList {
        var at = shapes.indexOf(ID)
        while (at >= 0) {
            val begin = at + ID.length
            var end = begin
            while (end < shapes.length && shapes[end].isWordPart()) end++
            val isName = at == 0 || !shapes[at - 1].isWordPart()
            if (isName && end > begin && shapes.getOrNull(end) == '"') add(shapes.substring(begin, end))
            at = shapes.indexOf(ID, begin)
        }
    }

    private fun Char.isWordPart() = this in 'a'..'z' || this in 'A'..'Z' || this in '0'..'9' || this == '_'

    /** The declarations of each class in [styles], without fonts and defaults. */
    private fun rules(styles: String): Map<String, String> = styleRule.findAll(styles).associate { rule ->
        val (name, declarations) = rule.destructured
        name to declarations.split(';').map(String::trim)
            .filter { it.isNotEmpty() && !it.startsWith("font-family") && !it.endsWith(": normal") }
            .joinToString(";") { it.replace(": ", ":") }
    }

    private fun checksum(text: String): String =
        CRC32().apply { update(text.toByteArray()) }.value.toString(HEXADECIMAL).padStart(8, '0')

    private fun escaped(text: String) = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")

    private const val MARK = '\u0001'
    private const val HEXADECIMAL = 16
    private const val SPARE = 400
}
