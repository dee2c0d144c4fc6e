package stillwater.plot

import java.math.BigDecimal
import java.math.RoundingMode

/**
 * The shapes of an SVG with nothing in them that is not seen: no indentation, empty elements closed in themselves,
 * numbers in attributes with two decimals, and style rules in place of the classes that stand for them.
 *
 * Goes through the text once: a map has a megabyte of it.
 *
 * @param shapes the library's elements, without style sheets. @param rules the declarations of each class.
 */
internal class CompactSvg(private val shapes: String, private val rules: Map<String, String>) {
    private val out = StringBuilder(shapes.length)
    private var at = 0

    /** Where the tag begins in [out] that the text is in. */
    private var tag = 0

    fun text(): String {
        while (at < shapes.length) {
            when (val mark = shapes[at]) {
                '\n' -> at = afterBlanks(at + 1)
                '<' -> {
                    tag = out.length
                    out.append(mark)
                    at++
                }
                '>' -> endTag()
                ' ' -> attribute()
                else -> {
                    out.append(mark)
                    at++
                }
            }
        }
        return out.toString()
    }

    private fun afterBlanks(from: Int): Int {
        var end = from
        while (end < shapes.length && shapes[end].isBlank()) end++
        return end
    }

    private fun Char.isBlank() = this == ' ' || this in '\t'..'\r'

    private fun endTag() {
        val next = if (at + 1 < shapes.length && shapes[at + 1] == '\n') afterBlanks(at + 2) else at + 1
        val empty = if (shapes.startsWith("</", next)) {
            EMPTY.firstOrNull { shapes.startsWith(it, next + 2) && shapes.startsWith(">", next + 2 + it.length) }
        } else {
            null
        }
        if (empty == null) {
            out.append('>')
            at = next
        } else {
            out.append("/>")
            at = next + empty.length + "</>".length
        }
        // A stroke of no width is none to SVG, but a hairline to Java's graphics, and so to jsvg.
        if (out.indexOf(NO_STROKE, tag) >= 0) {
            val plain = STROKE.replace(out.substring(tag), "")
            out.setLength(tag)
            out.append(plain)
        }
        tag = out.length
    }

    /** A blank, and the attribute behind it if there is one. */
    private fun attribute() {
        val assigned = nameEnd(at + 1)
        if (!shapes.startsWith("=\"", assigned)) {
            out.append(' ')
            at++
            return
        }
        val end = shapes.indexOf('"', assigned + 2)
        val value = shapes.substring(assigned + 2, end)
        when (val name = shapes.substring(at + 1, assigned)) {
            "clip-bounds-jfx" -> Unit
            "class" -> rules[value]?.let { append("style", it) }
            else -> append(name, value)
        }
        at = end + 1
    }

    private fun nameEnd(from: Int): Int {
        var end = from
        while (end < shapes.length && (shapes[end].isLetterOrDigit() || shapes[end] in "-:_")) end++
        return end
    }

    private fun append(name: String, value: String) {
        out.append(' ').append(name).append("=\"")
        val plain = value.replace(UNUSED_FONT, "")
        if ('.' in plain) appendRounded(plain) else out.append(plain)
        out.append('"')
    }

    private fun appendRounded(value: String) {
        var i = 0
        while (i < value.length) {
            val end = numberEnd(value, i)
            if (end == i) {
                out.append(value[i++])
            } else {
                appendRounded(value, i, end)
                i = end
            }
        }
    }

    /** The end of the number with a point and decimals that begins at [from]; [from] where none begins. */
    private fun numberEnd(value: String, from: Int): Int {
        var end = if (value[from] == '-') from + 1 else from
        val digits = digitsEnd(value, end)
        if (digits == end || digits >= value.length || value[digits] != '.') {
            // Digits without a point are copied as a whole: no number begins within them.
            return from
        }
        end = digitsEnd(value, digits + 1)
        if (end == digits + 1) return from
        if (end < value.length && value[end] == 'E') {
            val sign = if (end + 1 < value.length && value[end + 1] == '-') end + 2 else end + 1
            val exponent = digitsEnd(value, sign)
            if (exponent > sign) end = exponent
        }
        return end
    }

    private fun digitsEnd(value: String, from: Int): Int {
        var end = from
        while (end < value.length && value[end] in '0'..'9') end++
        return end
    }

    /** The number in [value] from [from] to [end], rounded half to even on two decimals, without zeros at its end. */
    private fun appendRounded(value: String, from: Int, end: Int) {
        val begin = if (value[from] == '-') from + 1 else from
        val point = value.indexOf('.', begin)
        val decimals = digitsEnd(value, point + 1)
        if (decimals < end || point - begin > MOST_DIGITS) {
            val exact = BigDecimal(value.substring(from, end)).setScale(2, RoundingMode.HALF_EVEN)
            out.append(exact.stripTrailingZeros().toPlainString())
            return
        }
        var hundredths = 0L
        for (i in begin until point) hundredths = hundredths * 10 + (value[i] - '0')
        for (i in point + 1..point + 2) hundredths = hundredths * 10 + if (i < decimals) value[i] - '0' else 0
        if (isRoundedUp(value, point + 3, decimals, hundredths % 2 == 1L)) hundredths++
        if (begin > from && hundredths > 0) out.append('-')
        out.append(hundredths / 100)
        val rest = (hundredths % 100).toInt()
        if (rest == 0) return
        out.append('.').append(rest / 10)
        if (rest % 10 > 0) out.append(rest % 10)
    }

    /** Whether the digits from [from] to [end] are more than half of one before them, or half and that one [isOdd]. */
    private fun isRoundedUp(value: String, from: Int, end: Int, isOdd: Boolean): Boolean {
        if (from >= end || value[from] != '5') return from < end && value[from] > '5'
        return isOdd || (from + 1 until end).any { value[it] != '0' }
    }

    private companion object {
        /** Digits before the point that, with two more, a Long has room for. */
        const val MOST_DIGITS = 15
        const val UNUSED_FONT = "font-family:sans-serif;"
        const val NO_STROKE = " stroke-width=\"0\""
        val EMPTY = listOf("path", "rect", "line", "circle", "polygon", "polyline")
        val STROKE = Regex(""" stroke(?:-width|-opacity)?="[^"]*"""")
    }
}
