package stillwater.plot

import com.github.weisj.jsvg.parser.DocumentLimits
import com.github.weisj.jsvg.parser.LoaderContext
import com.github.weisj.jsvg.parser.SVGLoader
import com.github.weisj.jsvg.renderer.NullPlatformSupport
import com.github.weisj.jsvg.view.ViewBox
import java.awt.Color
import java.awt.RenderingHints
import java.awt.image.BufferedImage
import java.io.ByteArrayOutputStream
import javax.imageio.ImageIO

/** Turns an SVG [Figure] into a PNG image on white. Works without a display; needs at least one font. */
internal object PngImage {
    /** Image px per CSS px: sharp on fine screens and in print. */
    const val SCALE = 2

    private val ownSvg = LoaderContext.builder().documentLimits(
        // The SVG is our own, and a map has as many paths as cells.
        DocumentLimits(
            DocumentLimits.DEFAULT_MAX_NESTING_DEPTH,
            DocumentLimits.DEFAULT_MAX_USE_NESTING_DEPTH,
            Int.MAX_VALUE,
        ),
    ).build()

    /** @throws FigureException if Java finds no font on this machine. */
    fun of(figure: Figure): ByteArray {
        System.setProperty("java.awt.headless", "true")
        return try {
            ByteArrayOutputStream().also { ImageIO.write(paint(figure), "png", it) }.toByteArray()
        } catch (failed: RuntimeException) {
            throw noImage(figure, failed)
        } catch (failed: Error) {
            // Java reports missing fonts as a plain Error, InternalError or LinkageError, depending on what is missing.
            if (failed is OutOfMemoryError || failed is StackOverflowError) throw failed
            throw noImage(figure, failed)
        }
    }

    private fun paint(figure: Figure): BufferedImage {
        // Null where the loader met something wrong, which it has logged.
        val document = checkNotNull(SVGLoader().load(figure.svg.byteInputStream(), null, ownSvg)) { "unreadable SVG" }
        val image = BufferedImage(figure.width * SCALE, figure.height * SCALE, BufferedImage.TYPE_INT_RGB)
        val canvas = image.createGraphics()
        try {
            canvas.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON)
            canvas.setRenderingHint(RenderingHints.KEY_STROKE_CONTROL, RenderingHints.VALUE_STROKE_PURE)
            canvas.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON)
            canvas.setRenderingHint(RenderingHints.KEY_FRACTIONALMETRICS, RenderingHints.VALUE_FRACTIONALMETRICS_ON)
            canvas.color = Color.WHITE
            canvas.fillRect(0, 0, image.width, image.height)
            document.renderWithPlatform(
                NullPlatformSupport.INSTANCE,
                canvas,
                ViewBox(image.width.toFloat(), image.height.toFloat()),
            )
        } finally {
            canvas.dispose()
        }
        return image
    }

    private fun noImage(figure: Figure, failed: Throwable): FigureException {
        // A class that could not be initialised for want of fonts says so in its cause only.
        val first = generateSequence(failed) { it.cause }.last()
        return FigureException(
            "cannot draw \"${figure.title}\" as PNG (${(first.message ?: first.javaClass.simpleName).trimEnd('.')}); " +
                "Java needs fontconfig and one font, such as the package fonts-dejavu-core; SVG needs none",
            failed,
        )
    }
}
