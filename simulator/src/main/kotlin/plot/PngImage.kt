package stillwater.plot

import java.awt.Color
import java.awt.RenderingHints
import java.awt.image.BufferedImage
import java.awt.image.DataBufferInt
import java.io.ByteArrayOutputStream
import java.io.DataOutputStream
import java.util.zip.CRC32
import java.util.zip.Deflater
import kotlin.math.roundToInt

/** Turns an SVG [Figure] into a PNG image on white. Works without a display; needs at least one font. */
internal object PngImage {
    /**
     * @param scale image px per CSS px.
     * @throws FigureException if Java finds no font on this machine.
     */
    fun of(figure: Figure, scale: Double): ByteArray {
        System.setProperty("java.awt.headless", "true")
        return try {
            encode(paint(figure, scale))
        } catch (failed: FigureException) {
            throw failed
        } catch (failed: RuntimeException) {
            throw noImage(figure, failed)
        } catch (failed: Error) {
            // Java reports missing fonts as a plain Error, InternalError or LinkageError, depending on what is missing.
            if (failed is OutOfMemoryError || failed is StackOverflowError) throw failed
            throw noImage(figure, failed)
        }
    }

    private fun paint(figure: Figure, scale: Double): BufferedImage {
        val width = (figure.width * scale).roundToInt().coerceAtLeast(1)
        val height = (figure.height * scale).roundToInt().coerceAtLeast(1)
        val image = BufferedImage(width, height, BufferedImage.TYPE_INT_RGB)
        val canvas = image.createGraphics()
        try {
            canvas.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON)
            canvas.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON)
            canvas.setRenderingHint(RenderingHints.KEY_FRACTIONALMETRICS, RenderingHints.VALUE_FRACTIONALMETRICS_ON)
            canvas.setRenderingHint(RenderingHints.KEY_STROKE_CONTROL, RenderingHints.VALUE_STROKE_PURE)
            canvas.color = Color.WHITE
            canvas.fillRect(0, 0, width, height)
            canvas.scale(scale, scale)
            SvgPainter(canvas).paint(figure.svg)
        } finally {
            canvas.dispose()
        }
        return image
    }

    /** PNG (ISO/IEC 15948): 8-bit RGB, rows unfiltered, which suits flat colours. */
    private fun encode(image: BufferedImage): ByteArray {
        val pixels = (image.raster.dataBuffer as DataBufferInt).data
        val rows = ByteArray(image.height * (1 + RGB * image.width))
        var at = 0
        for (y in 0 until image.height) {
            rows[at++] = 0
            for (x in 0 until image.width) {
                val pixel = pixels[y * image.width + x]
                rows[at++] = (pixel shr 16).toByte()
                rows[at++] = (pixel shr 8).toByte()
                rows[at++] = pixel.toByte()
            }
        }
        val file = ByteArrayOutputStream()
        DataOutputStream(file).use { out ->
            out.write(SIGNATURE)
            out.chunk("IHDR") {
                writeInt(image.width)
                writeInt(image.height)
                write(byteArrayOf(BITS, TRUE_COLOUR, 0, 0, 0))
            }
            out.chunk("IDAT") { write(deflated(rows)) }
            out.chunk("IEND") {}
        }
        return file.toByteArray()
    }

    private fun deflated(bytes: ByteArray): ByteArray {
        val deflater = Deflater(LEVEL)
        try {
            deflater.setInput(bytes)
            deflater.finish()
            val out = ByteArrayOutputStream()
            val buffer = ByteArray(BUFFER)
            while (!deflater.finished()) out.write(buffer, 0, deflater.deflate(buffer))
            return out.toByteArray()
        } finally {
            deflater.end()
        }
    }

    private fun DataOutputStream.chunk(name: String, content: DataOutputStream.() -> Unit) {
        val bytes = ByteArrayOutputStream()
        DataOutputStream(bytes).apply { writeBytes(name) }.content()
        val data = bytes.toByteArray()
        writeInt(data.size - name.length)
        write(data)
        writeInt(CRC32().apply { update(data) }.value.toInt())
    }

    private fun noImage(figure: Figure, cause: Throwable) = FigureException(
        "cannot draw \"${figure.title}\" as PNG (${(cause.message ?: cause.javaClass.simpleName).trimEnd('.')}); " +
            "Java needs fontconfig and one font, such as the package fonts-dejavu-core; SVG needs none",
        cause,
    )

    private val SIGNATURE = byteArrayOf(0x89.toByte(), 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A)
    private const val RGB = 3
    private const val BITS: Byte = 8
    private const val TRUE_COLOUR: Byte = 2
    private const val LEVEL = 6
    private const val BUFFER = 1 shl 16
}
