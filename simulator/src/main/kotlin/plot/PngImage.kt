package stillwater.plot

import com.github.weisj.jsvg.parser.DocumentLimits
import com.github.weisj.jsvg.parser.LoaderContext
import com.github.weisj.jsvg.parser.SVGLoader
import com.github.weisj.jsvg.renderer.NullPlatformSupport
import com.github.weisj.jsvg.view.ViewBox
import java.awt.Color
import java.awt.RenderingHints
import java.awt.image.BufferedImage
import java.awt.image.DataBufferInt
import java.io.ByteArrayOutputStream
import java.io.DataOutputStream
import java.util.zip.CRC32
import java.util.zip.Deflater
import java.util.zip.DeflaterOutputStream

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
            encoded(paint(figure))
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

    /**
     * The file of [image], three bytes a pixel, each row as its difference from the one above: most of a figure is the
     * same downwards. Written here because Java's own writer goes through every pixel several times to choose among
     * filters. Source: PNG specification, third edition, 5 and 9.2.
     */
    private fun encoded(image: BufferedImage): ByteArray {
        val file = ByteArrayOutputStream()
        val out = DataOutputStream(file)
        out.writeLong(SIGNATURE)
        chunk(out, "IHDR") {
            it.writeInt(image.width)
            it.writeInt(image.height)
            // 8 bits of each of red, green and blue, not interlaced.
            it.write(byteArrayOf(8, 2, 0, 0, 0))
        }
        chunk(out, "IDAT") { pixels(image, it) }
        chunk(out, "IEND") { }
        return file.toByteArray()
    }

    private fun pixels(image: BufferedImage, into: DataOutputStream) {
        val deflater = Deflater(COMPRESSION)
        val packed = DeflaterOutputStream(into, deflater, BUFFER)
        val pixels = (image.raster.dataBuffer as DataBufferInt).data
        val width = image.width
        val row = ByteArray(1 + 3 * width)
        row[0] = UP
        for (y in 0 until image.height) {
            for (x in 0 until width) {
                val here = pixels[y * width + x]
                val above = if (y == 0) 0 else pixels[(y - 1) * width + x]
                row[1 + 3 * x] = ((here shr 16) - (above shr 16)).toByte()
                row[2 + 3 * x] = ((here shr 8) - (above shr 8)).toByte()
                row[3 + 3 * x] = (here - above).toByte()
            }
            packed.write(row)
        }
        packed.finish()
        deflater.end()
    }

    private fun chunk(out: DataOutputStream, type: String, content: (DataOutputStream) -> Unit) {
        val bytes = ByteArrayOutputStream()
        DataOutputStream(bytes).use {
            it.writeBytes(type)
            content(it)
        }
        out.writeInt(bytes.size() - type.length)
        bytes.writeTo(out)
        out.writeInt(CRC32().apply { update(bytes.toByteArray()) }.value.toInt())
    }

    private const val SIGNATURE = -0x76afb1b8f2f5e5f6L
    private const val UP: Byte = 2

    /** Of 1 to 9: above, the files are little smaller. */
    private const val COMPRESSION = 4
    private const val BUFFER = 1 shl 16

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
