package stillwater.report

import kotlinx.html.FlowContent
import kotlinx.html.TABLE
import kotlinx.html.ThScope
import kotlinx.html.classes
import kotlinx.html.code
import kotlinx.html.dd
import kotlinx.html.details
import kotlinx.html.div
import kotlinx.html.dl
import kotlinx.html.dt
import kotlinx.html.figcaption
import kotlinx.html.figure
import kotlinx.html.p
import kotlinx.html.pre
import kotlinx.html.summary
import kotlinx.html.table
import kotlinx.html.tbody
import kotlinx.html.td
import kotlinx.html.th
import kotlinx.html.thead
import kotlinx.html.tr
import kotlinx.html.unsafe
import stillwater.plot.Figure

/** What a section of an [HtmlReport] can hold, in order. All texts are plain and are escaped. */
public class ReportSection internal constructor(private val into: FlowContent) {
    /** A paragraph. */
    public fun paragraph(text: String): Unit = into.p { +text }

    /** A figure, drawn inline, with its [caption] under it; none if empty. */
    public fun figure(figure: Figure, caption: String = ""): Unit = into.figure {
        div("drawing") { unsafe { +figure.svg } }
        if (caption.isNotEmpty()) figcaption { +caption }
    }

    /** A table; on a narrow screen it scrolls sideways by itself. */
    public fun table(table: Table, caption: String = "") {
        into.div("scroll") {
            if (caption.isNotEmpty()) p("caption") { +caption }
            table { fill(table) }
        }
    }

    /** Names and values, one pair a line. */
    public fun keyValues(pairs: List<Pair<String, String>>): Unit = into.keyValues(pairs, "")

    /** Text as typed, such as a command. */
    public fun code(text: String): Unit = into.pre { code { +text } }

    /** A box of warnings; nothing if there are none. */
    public fun warnings(texts: List<String>) {
        if (texts.isNotEmpty()) into.div("warnings") { texts.forEach { p { +it } } }
    }

    /** Content that is folded away under [title] until opened. */
    public fun details(title: String, content: ReportSection.() -> Unit): Unit = into.details {
        summary { +title }
        div { ReportSection(this).content() }
    }

    private fun TABLE.fill(table: Table) {
        thead {
            tr {
                table.columns.forEach { column ->
                    th(scope = ThScope.col) {
                        if (column.align == Align.RIGHT) classes = setOf("number")
                        +column.header
                    }
                }
            }
        }
        tbody {
            table.rows.forEach { row ->
                tr {
                    row.forEachIndexed { index, text ->
                        td {
                            if (table.columns[index].align == Align.RIGHT) classes = setOf("number")
                            +text
                        }
                    }
                }
            }
        }
    }
}

/** A list of names and values with the style class [style]. */
internal fun FlowContent.keyValues(pairs: List<Pair<String, String>>, style: String) {
    val page = this
    dl(style.ifEmpty { null }) {
        val list = this
        pairs.forEach { (name, value) ->
            // HTML allows a div around each pair, which the builder's types do not know.
            page.div {
                list.dt { +name }
                list.dd { +value }
            }
        }
    }
}
