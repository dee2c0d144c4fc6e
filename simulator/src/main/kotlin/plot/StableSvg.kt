package stillwater.plot

import java.util.Locale
import java.util.zip.CRC32

/**
 * Makes the plot library's SVG the same for the same data, smaller, scalable and safe to put beside others in a page.
 *
 * Random element ids become ids made from the document's own content, so that two figures inlined in one page do not
 * share any; numbers in attributes keep two decimals (0.01 px); style rules that no element uses go; a view box lets
 * a page scale the figure; fonts are those that common systems have.
 */
internal object StableSvg {
    private val id = Regex("""\bid="(\w+)"""")
    private val attribute = Regex("""="([^"]*)"""")
    private val longNumber = Regex("""-?\d+\.\d+(?:E-?\d+)?""")
    private val styleElement = Regex("""(?s)\s*<style type="text/css">.*?</style>""")
    private val styleRule = Regex("""(?s)#(\w+) \.([\w-]+) \{\s*(.*?)\s*\}""")
    private val usedClass = Regex("""class="([\w-]+)"""")
    private val indentation = Regex("""\n\s*""")
    private val unused = Regex("""font-family:sans-serif;| clip-bounds-jfx="[^"]*"""")
    private val emptyElement = Regex("""></(?:rect|path|line|circle|polygon|polyline)>""")
    private const val FONTS = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"

    /**
     * @param drawn the library's document.
     * @param title the accessible name, plain text.
     * @param width drawn width, px.
     * @param height drawn height, px.
     */
    fun of(drawn: String, title: String, width: Int, height: Int): String {
        val body = drawn.substringAfter('>').substringBeforeLast("</svg>")
        val shapes = compact(styleElement.replace(body, ""))
        val ids = id.findAll(shapes).map { it.groupValues[1] }.toList()
        val numbered = ids.foldIndexed(shapes) { n, text, name -> text.replace(name, "$MARK$n$MARK") }
        val style = style(body, shapes)
        val prefix = "f" + checksum(title + style + numbered)
        val stable = ids.indices.fold(numbered) { text, n -> text.replace("$MARK$n$MARK", "$prefix-$n") }
        return buildString(stable.length + style.length + SPARE) {
            append("""<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" """)
            append("""id="$prefix" role="img" width="$width" height="$height" viewBox="0 0 $width $height">""")
            append("<title>").append(escaped(title)).append("</title>")
            append("<style>#$prefix text{font-family:$FONTS}")
            append(style.replace(SCOPE, "#$prefix ")).append("</style>")
            append(stable).append("</svg>\n")
        }
    }

    /** Rules of the classes that [shapes] uses, each written once, scoped to the figure. */
    private fun style(body: String, shapes: String): String {
        val used = usedClass.findAll(shapes).map { it.groupValues[1] }.toSet()
        return styleRule.findAll(body)
            .filter { it.groupValues[2] in used }
            .map { rule ->
                val declarations = rule.groupValues[3].split(';').map(String::trim)
                    .filter { it.isNotEmpty() && !it.startsWith("font-family") && !it.endsWith(": normal") }
                "$SCOPE.${rule.groupValues[2]}{${declarations.joinToString(";") { it.replace(": ", ":") }}}"
            }
            .distinct().sorted().joinToString("")
    }

    private fun compact(shapes: String): String {
        val plain = unused.replace(shapes, "")
        val dense = emptyElement.replace(indentation.replace(plain, ""), "/>")
        return attribute.replace(dense) { match ->
            val value = match.groupValues[1]
            if ('.' in value) "=\"" + longNumber.replace(value) { rounded(it.value) } + "\"" else match.value
        }
    }

    private fun rounded(number: String): String {
        val value = number.toDouble()
        val hundredths = Math.round(value * HUNDRED)
        if (Math.abs(value) >= LARGE) return String.format(Locale.ROOT, "%.0f", value)
        val whole = Math.abs(hundredths) / HUNDRED.toInt()
        val rest = (Math.abs(hundredths) % HUNDRED.toInt()).toInt()
        val fraction = when {
            rest == 0 -> ""
            rest % TEN == 0 -> "." + rest / TEN
            else -> "." + rest.toString().padStart(2, '0')
        }
        return (if (hundredths < 0) "-" else "") + whole + fraction
    }

    private fun checksum(text: String): String =
        CRC32().apply { update(text.toByteArray()) }.value.toString(HEXADECIMAL).padStart(8, '0')

    private fun escaped(text: String) = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")

    private const val MARK = '\u0001'
    private const val SCOPE = "\u0002"
    private const val HUNDRED = 100.0
    private const val TEN = 10
    private const val LARGE = 1e12
    private const val HEXADECIMAL = 16
    private const val SPARE = 400
}
