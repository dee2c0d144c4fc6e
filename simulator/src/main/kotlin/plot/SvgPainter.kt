package stillwater.plot

import java.awt.AlphaComposite
import java.awt.BasicStroke
import java.awt.Color
import java.awt.Font
import java.awt.Graphics2D
import java.awt.Shape
import java.awt.geom.AffineTransform
import java.awt.geom.Ellipse2D
import java.awt.geom.Line2D
import java.awt.geom.Path2D
import java.awt.geom.Rectangle2D
import java.io.StringReader
import javax.xml.stream.XMLInputFactory
import javax.xml.stream.XMLStreamConstants
import javax.xml.stream.XMLStreamReader

/**
 * Paints the SVG of a [Figure]. It knows the small part of SVG that [StableSvg] lets through (groups, straight
 * paths, rectangles, lines, circles, text, rectangular clips) and refuses anything else rather than leave it out.
 *
 * A general SVG renderer does the same in four times the time on a cold JVM, which a short command would feel.
 *
 * @param canvas where to paint, scaled to CSS px. Modified.
 */
internal class SvgPainter(private val canvas: Graphics2D) {
    private val styles = HashMap<String, Map<String, String>>()
    private val groups = ArrayDeque<Pair<AffineTransform, Shape?>>()
    private var openClip: String? = null

    /** The clip that the group just entered refers to; the library defines it as the group's first child. */
    private var awaitedClip: String? = null

    /** @throws FigureException on an element that this painter does not know. */
    fun paint(svg: String) {
        val factory = XMLInputFactory.newDefaultFactory()
        factory.setProperty(XMLInputFactory.SUPPORT_DTD, false)
        val reader = factory.createXMLStreamReader(StringReader(svg))
        while (reader.hasNext()) {
            when (reader.next()) {
                XMLStreamConstants.START_ELEMENT -> open(reader)
                XMLStreamConstants.END_ELEMENT -> close(reader.localName)
            }
        }
    }

    private fun open(element: XMLStreamReader) {
        when (val name = element.localName) {
            "svg", "defs" -> Unit
            "title" -> element.elementText
            "style" -> readStyles(element.elementText)
            "g" -> enter(element)
            "clipPath" -> openClip = element["id"]
            "rect" -> rectangle(element)
            "line" -> shape(
                element,
                Line2D.Double(element.number("x1"), element.number("y1"), element.number("x2"), element.number("y2")),
            )
            "circle" -> shape(element, circle(element))
            "path" -> shape(element, path(element["d"].orEmpty(), element["fill-rule"] == "evenodd"))
            "text" -> text(element)
            else -> throw FigureException("cannot paint the SVG element <$name>")
        }
    }

    private fun close(name: String) {
        when (name) {
            "g" -> groups.removeLast().let { (transform, clip) ->
                canvas.transform = transform
                canvas.clip = clip
            }
            "clipPath" -> openClip = null
        }
    }

    private fun enter(element: XMLStreamReader) {
        groups.addLast(canvas.transform to canvas.clip)
        element["transform"]?.let { canvas.transform(transform(it)) }
        awaitedClip = element["clip-path"]?.substringAfter('#')?.substringBefore(')')
    }

    private fun rectangle(element: XMLStreamReader) {
        val rectangle = Rectangle2D.Double(
            element.number("x"),
            element.number("y"),
            element.number("width"),
            element.number("height"),
        )
        if (openClip == null) return shape(element, rectangle)
        if (openClip != awaitedClip) throw FigureException("the SVG clips by $openClip where $awaitedClip is used")
        canvas.clip(rectangle)
        awaitedClip = null
    }

    private fun circle(element: XMLStreamReader): Shape {
        val r = element.number("r")
        return Ellipse2D.Double(element.number("cx") - r, element.number("cy") - r, 2 * r, 2 * r)
    }

    private fun shape(element: XMLStreamReader, shape: Shape) {
        paint(element["fill"] ?: "rgb(0,0,0)", element["fill-opacity"]) { canvas.fill(shape) }
        val width = element.number("stroke-width", 1.0).toFloat()
        if (width <= 0) return
        paint(element["stroke"] ?: return, element["stroke-opacity"]) {
            val dashes = element["stroke-dasharray"]?.split(',')?.map(String::toFloat)?.toFloatArray()
            canvas.stroke = BasicStroke(width, BasicStroke.CAP_BUTT, BasicStroke.JOIN_MITER, MITER, dashes, 0f)
            canvas.draw(shape)
        }
    }

    private fun text(element: XMLStreamReader) {
        val style = styles[element["class"]].orEmpty() + declarations(element["style"].orEmpty())
        val size = style["font-size"]?.removeSuffix("px")?.toFloat() ?: DEFAULT_SIZE
        val weight = if (style["font-weight"] == "bold") Font.BOLD else Font.PLAIN
        val slope = if (style["font-style"] == "italic") Font.ITALIC else Font.PLAIN
        val font = Font(Font.SANS_SERIF, weight or slope, 1).deriveFont(size)
        val x = element.number("x")
        val y = element.number("y") + (element["dy"]?.removeSuffix("em")?.toDouble() ?: 0.0) * size
        val anchor = element["text-anchor"]
        val own = element["transform"]?.let(::transform)
        val opacity = element["fill-opacity"]
        val words = element.elementText.trim()
        if (words.isEmpty()) return
        val width = font.getStringBounds(words, canvas.fontRenderContext).width
        val left = when (anchor) {
            "middle" -> x - width / 2
            "end" -> x - width
            else -> x
        }
        val before = canvas.transform
        own?.let(canvas::transform)
        canvas.font = font
        paint(style["fill"] ?: "#000000", opacity) { canvas.drawString(words, left.toFloat(), y.toFloat()) }
        canvas.transform = before
    }

    private inline fun paint(colour: String, opacity: String?, draw: () -> Unit) {
        val share = opacity?.toFloat() ?: 1f
        if (colour == "none" || share <= 0) return
        canvas.color = colour(colour)
        if (share >= 1) return draw()
        val before = canvas.composite
        canvas.composite = AlphaComposite.getInstance(AlphaComposite.SRC_OVER, share)
        draw()
        canvas.composite = before
    }

    private fun readStyles(sheet: String) {
        for (rule in sheet.split('}')) {
            val selector = rule.substringBefore('{').trim()
            if ('.' in selector) styles[selector.substringAfterLast('.')] = declarations(rule.substringAfter('{'))
        }
    }

    private companion object {
        const val MITER = 4f
        const val DEFAULT_SIZE = 14f
        val separators = Regex("[ ,]+")

        operator fun XMLStreamReader.get(attribute: String): String? = getAttributeValue(null, attribute)

        fun XMLStreamReader.number(attribute: String, default: Double = 0.0): Double =
            this[attribute]?.toDouble() ?: default

        fun declarations(text: String): Map<String, String> = text.split(';').filter { ':' in it }
            .associate { it.substringBefore(':').trim() to it.substringAfter(':').trim() }

        fun colour(text: String): Color {
            if (text.startsWith("#")) return Color.decode(text)
            if (!text.startsWith("rgb(")) throw FigureException("cannot paint the SVG colour $text")
            val (red, green, blue) = text.removePrefix("rgb(").removeSuffix(")").split(',').map { it.trim().toInt() }
            return Color(red, green, blue)
        }

        fun transform(text: String): AffineTransform {
            val all = AffineTransform()
            for (step in text.split(')').map(String::trim).filter(String::isNotEmpty)) {
                val numbers = step.substringAfter('(').trim().split(separators).map(String::toDouble)
                when (val kind = step.substringBefore('(').trim()) {
                    "translate" -> all.translate(numbers[0], numbers.getOrElse(1) { 0.0 })
                    "rotate" -> all.rotate(
                        Math.toRadians(numbers[0]),
                        numbers.getOrElse(1) {
                            0.0
                        },
                        numbers.getOrElse(2) { 0.0 },
                    )
                    else -> throw FigureException("cannot paint the SVG transform $kind")
                }
            }
            return all
        }

        fun path(data: String, evenOdd: Boolean): Path2D {
            val path = Path2D.Double(if (evenOdd) Path2D.WIND_EVEN_ODD else Path2D.WIND_NON_ZERO)
            for (step in data.replace("Z", " Z").split(Regex("(?=[A-Za-z])")).map(String::trim)) {
                if (step.isEmpty()) continue
                val numbers = step.drop(1).trim().split(separators).filter(String::isNotEmpty).map(String::toDouble)
                when (step[0]) {
                    'M' -> path.moveTo(numbers[0], numbers[1])
                    'L' -> path.lineTo(numbers[0], numbers[1])
                    'Z' -> path.closePath()
                    else -> throw FigureException("cannot paint the SVG path step ${step[0]}")
                }
            }
            return path
        }
    }
}
