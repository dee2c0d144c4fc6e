package stillwater.hidden

import java.nio.file.Files
import java.nio.file.Path
import java.util.Locale
import kotlin.math.sqrt

/** Draws the confusability matrix and the power curves of docs/diagnosis.md from a campaign's table of cases. */
internal class HiddenFigures(table: List<String>) {
    private class Case(fields: Map<String, String>) {
        val hidden = fields.getValue("hidden")
        val multiple = fields.getValue("multiple").toDouble()
        val said = fields.getValue("said").split(" + ").map { it.split("/") }
        val correct = said.any { hidden in it && it.size <= 2 } && said.all { hidden in it }
    }

    private val causes = HiddenEffect.entries.filter { it.listed }.map { it.label }
    private val names = table.first().split('\t')
    private val cases = table.drop(1).map { Case(names.zip(it.split('\t')).toMap()) }

    /** For each hidden cause at 1x and above the share of cases in which each cause was in the answer. */
    fun confusability(): String {
        val columns = causes + listOf("unexplained", "consistent", "insufficient-data")
        val drawing = Svg(LEFT + CELL * columns.size + 10, TOP + CELL * (causes.size + 1) + 10)
        columns.forEachIndexed { k, name -> drawing.turned(LEFT + CELL * k + CELL * 0.7, TOP - 6.0, name) }
        (causes + "none").forEachIndexed { row, cause ->
            val own = cases.filter { it.hidden == cause && (cause == "none" || it.multiple >= 1) }
            val y = TOP + CELL * row
            drawing.text(LEFT - 6.0, y + CELL * 0.65, "$cause (${own.size})", "end")
            columns.forEachIndexed { k, name ->
                val count = own.count { case -> case.said.any { name in it } }
                val share = if (own.isEmpty()) 0.0 else count.toDouble() / own.size
                drawing.cell(LEFT + CELL * k, y, CELL, share, if (count == 0) "" else "$count")
            }
        }
        return drawing.toString()
    }

    /** For each cause the share named correctly against the strength, with 95 % intervals (Wilson). */
    fun power(): String {
        val perRow = 5
        val rows = (causes.size + perRow - 1) / perRow
        val drawing = Svg(perRow * PANEL + 20, rows * (PANEL + 14) + 10)
        causes.forEachIndexed { k, cause ->
            val x = 10 + k % perRow * PANEL
            val y = 10 + k / perRow * (PANEL + 14)
            drawing.text(x + PANEL / 2.0, y + 10.0, cause, "middle")
            drawing.frame(x + 24, y + 16, PANEL - 34, PANEL - 36)
            BINS.forEachIndexed { bin, (from, to) ->
                val own = cases.filter { it.hidden == cause && it.multiple >= from && it.multiple < to }
                val place = x + 24 + (PANEL - 34) * (bin + 0.5) / BINS.size
                fun height(share: Double) = y + 16 + (PANEL - 36) * (1 - share)
                drawing.text(place, y + PANEL - 8.0, LABELS[bin], "middle")
                if (own.isEmpty()) return@forEachIndexed
                val (low, high) = wilson(own.count { it.correct }, own.size)
                val share = own.count { it.correct }.toDouble() / own.size
                drawing.whisker(place, height(low), height(high), height(share))
            }
        }
        return drawing.toString()
    }

    private fun wilson(hits: Int, of: Int): Pair<Double, Double> {
        val z = 1.96
        val share = hits.toDouble() / of
        val middle = (share + z * z / (2 * of)) / (1 + z * z / of)
        val half = z / (1 + z * z / of) * sqrt(share * (1 - share) / of + z * z / (4.0 * of * of))
        return middle - half to middle + half
    }

    /** An SVG drawing as it grows, on white, in CSS px. */
    private class Svg(width: Int, height: Int) {
        private val out = StringBuilder(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"$width\" height=\"$height\" " +
                "font-family=\"sans-serif\" font-size=\"11\">" +
                "<rect width=\"$width\" height=\"$height\" fill=\"white\"/>\n",
        )

        private fun number(value: Number) = "%.1f".format(Locale.ROOT, value.toDouble())

        fun text(x: Double, y: Double, text: String, anchor: String) {
            out.append("<text x=\"${number(x)}\" y=\"${number(y)}\" text-anchor=\"$anchor\">$text</text>\n")
        }

        fun turned(x: Double, y: Double, text: String) {
            out.append("<text transform=\"translate(${number(x)} ${number(y)}) rotate(-60)\">$text</text>\n")
        }

        fun cell(x: Int, y: Int, size: Int, share: Double, text: String) {
            val light = number(100 - 65 * share)
            out.append("<rect x=\"$x\" y=\"$y\" width=\"$size\" height=\"$size\" stroke=\"#ddd\" ")
            out.append("fill=\"hsl(210 70% $light%)\"/>\n")
            if (text.isEmpty()) return
            val colour = if (share > DARK) "white" else "black"
            out.append("<text x=\"${number(x + size / 2.0)}\" y=\"${number(y + size * 0.65)}\" text-anchor=\"middle\" ")
            out.append("fill=\"$colour\">$text</text>\n")
        }

        fun frame(x: Int, y: Int, width: Int, height: Int) {
            out.append("<rect x=\"$x\" y=\"$y\" width=\"$width\" height=\"$height\" fill=\"none\" stroke=\"#999\"/>\n")
            text(x - 3.0, y + 9.0, "1", "end")
            text(x - 3.0, y + height.toDouble(), "0", "end")
        }

        fun whisker(x: Double, low: Double, high: Double, value: Double) {
            out.append("<path d=\"M${number(x)} ${number(low)}V${number(high)}\" stroke=\"#2a6fb0\"/>")
            out.append("<circle cx=\"${number(x)}\" cy=\"${number(value)}\" r=\"4\" fill=\"#2a6fb0\"/>\n")
        }

        override fun toString() = "$out</svg>\n"

        private companion object {
            const val DARK = 0.5
        }
    }

    private companion object {
        const val LEFT = 240
        const val TOP = 190
        const val CELL = 24
        const val PANEL = 170
        val BINS = listOf(0.25 to 0.5, 0.5 to 1.0, 1.0 to 2.0, 2.0 to 4.01)
        val LABELS = listOf("¼–½", "½–1", "1–2", "2–4")
    }
}

/** `CASES.tsv DIRECTORY`: draws both figures into DIRECTORY. */
fun main(arguments: Array<String>) {
    val figures = HiddenFigures(Files.readAllLines(Path.of(arguments[0])))
    val directory = Path.of(arguments[1])
    Files.writeString(directory.resolve("diagnosis-confusability.svg"), figures.confusability())
    Files.writeString(directory.resolve("diagnosis-power.svg"), figures.power())
}
