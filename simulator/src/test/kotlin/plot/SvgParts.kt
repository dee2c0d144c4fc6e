package stillwater.plot

import org.w3c.dom.Element
import javax.xml.parsers.DocumentBuilderFactory

/** A figure's SVG read back as data by the JDK's own XML parser, which also proves that it is well formed. */
internal class SvgParts(figure: Figure) {
    private val document = DocumentBuilderFactory.newInstance().newDocumentBuilder().parse(figure.svg.byteInputStream())

    val root: Element = document.documentElement

    val texts: List<String> = all("text").map { it.textContent.trim() }

    fun all(name: String): List<Element> = document.getElementsByTagName(name).let { found ->
        List(found.length) { found.item(it) as Element }
    }

    /** Paths stroked in [colour] (`rgb(r,g,b)`), which are the lines of a curve. */
    fun strokes(colour: String): List<Element> = all("path").filter { it.getAttribute("stroke") == colour }

    /** Paths filled with [colour]. */
    fun fills(colour: String): List<Element> = all("path").filter { it.getAttribute("fill") == colour }

    companion object {
        const val BLUE = "rgb(0,114,178)"
        const val VERMILION = "rgb(213,94,0)"
        const val GREEN = "rgb(0,158,115)"
        const val GREY = "rgb(217,220,223)"
    }
}
