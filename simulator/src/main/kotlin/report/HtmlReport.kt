package stillwater.report

import kotlinx.html.FlowContent
import kotlinx.html.a
import kotlinx.html.body
import kotlinx.html.code
import kotlinx.html.div
import kotlinx.html.footer
import kotlinx.html.h1
import kotlinx.html.h2
import kotlinx.html.head
import kotlinx.html.header
import kotlinx.html.html
import kotlinx.html.id
import kotlinx.html.lang
import kotlinx.html.li
import kotlinx.html.main
import kotlinx.html.meta
import kotlinx.html.nav
import kotlinx.html.p
import kotlinx.html.section
import kotlinx.html.span
import kotlinx.html.stream.appendHTML
import kotlinx.html.style
import kotlinx.html.title
import kotlinx.html.ul
import kotlinx.html.unsafe

/**
 * What a report's footer says, so that the run can be repeated.
 *
 * @property version this program's version. @property command the command line as typed.
 * @property seed the run's seed, or null where nothing is random. @property seedName what it is the seed of.
 */
public class Provenance(
    public val version: String,
    public val command: String,
    public val seed: Long? = null,
    public val seedName: String = "Seed",
)

/**
 * One self-contained page about a run: no script, no outside file, light and dark, readable on a phone and on paper.
 *
 * All texts are plain and are escaped here. Build it in order, then [render] it; the same calls give the same text.
 * Not thread-safe.
 *
 * @param title what was run, such as `Benchmark`. @param subtitle one sentence under it; none if empty.
 */
public class HtmlReport(private val title: String, private val subtitle: String, private val provenance: Provenance) {
    private val summary = ArrayList<Pair<String, String>>()
    private val warnings = ArrayList<String>()
    private val answers = ArrayList<String>()
    private val sections = ArrayList<Pair<String, ReportSection.() -> Unit>>()

    /** Adds a sentence that is the run's answer: before all else, and before the warnings. */
    public fun answer(text: String) {
        answers += text
    }

    /** Adds a fact to the summary at the top, such as `Rows read` to `12 345`. */
    public fun summary(name: String, value: String) {
        summary += name to value
    }

    /** Adds a sentence to the box of warnings at the top; there is no box without any. */
    public fun warning(text: String) {
        warnings += text
    }

    /** Adds a section; [content] runs when the page is rendered. */
    public fun section(heading: String, content: ReportSection.() -> Unit) {
        sections += heading to content
    }

    /** The page's text, UTF-8. */
    public fun render(): String = buildString {
        append("<!DOCTYPE html>\n")
        appendHTML(prettyPrint = false).html {
            lang = "en"
            head {
                meta(charset = "utf-8")
                meta(name = "viewport", content = "width=device-width, initial-scale=1")
                meta(name = "color-scheme", content = "light dark")
                meta(name = "generator", content = "Stillwater ${provenance.version}")
                title(this@HtmlReport.title)
                style { unsafe { +HtmlStyle.SHEET } }
            }
            body {
                header {
                    p("brand") { +"Stillwater" }
                    h1 { +this@HtmlReport.title }
                    if (subtitle.isNotEmpty()) p("subtitle") { +subtitle }
                }
                main {
                    answers.forEach { p("answer") { +it } }
                    warningBox()
                    if (summary.isNotEmpty()) keyValues(summary, "summary")
                    if (sections.size > 2) contents()
                    sections.forEachIndexed { index, (heading, content) ->
                        section {
                            id = "section-${index + 1}"
                            h2 { +heading }
                            ReportSection(this).content()
                        }
                    }
                }
                footer { provenance() }
            }
        }
        append('\n')
    }

    private fun FlowContent.warningBox() {
        if (warnings.isEmpty()) return
        div("warnings") {
            attributes["role"] = "note"
            p { +(if (warnings.size == 1) "1 warning" else "${warnings.size} warnings") }
            ul { warnings.forEach { li { +it } } }
        }
    }

    private fun FlowContent.contents(): Unit = nav {
        attributes["aria-label"] = "Sections"
        ul {
            sections.forEachIndexed { index, (heading, _) ->
                li { a(href = "#section-${index + 1}") { +heading } }
            }
        }
    }

    private fun FlowContent.provenance() {
        p { +"Made by Stillwater ${provenance.version}." }
        p {
            +"Command: "
            code { +provenance.command }
        }
        provenance.seed?.let { seed ->
            p {
                +"${provenance.seedName}: "
                span("number") { +seed.toString() }
            }
        }
    }
}
