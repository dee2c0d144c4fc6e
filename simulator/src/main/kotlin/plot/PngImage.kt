package stillwater.plot

import org.apache.batik.transcoder.SVGAbstractTranscoder
import org.apache.batik.transcoder.TranscoderInput
import org.apache.batik.transcoder.TranscoderOutput
import org.apache.batik.transcoder.image.ImageTranscoder
import org.apache.batik.transcoder.image.PNGTranscoder
import java.awt.Color
import java.io.ByteArrayOutputStream
import java.io.StringReader

/** Turns an SVG [Figure] into a PNG image. Works without a display; needs at least one font. */
internal object PngImage {
    fun of(figure: Figure, scale: Double): ByteArray {
        System.setProperty("java.awt.headless", "true")
        val image = ByteArrayOutputStream()
        try {
            PNGTranscoder().apply {
                addTranscodingHint(SVGAbstractTranscoder.KEY_WIDTH, (figure.width * scale).toFloat())
                addTranscodingHint(SVGAbstractTranscoder.KEY_HEIGHT, (figure.height * scale).toFloat())
                addTranscodingHint(ImageTranscoder.KEY_BACKGROUND_COLOR, Color.WHITE)
                addTranscodingHint(SVGAbstractTranscoder.KEY_ALLOW_EXTERNAL_RESOURCES, false)
                transcode(TranscoderInput(StringReader(figure.svg)), TranscoderOutput(image))
            }
        } catch (failed: Exception) {
            throw noImage(figure, failed)
        } catch (failed: LinkageError) {
            throw noImage(figure, failed)
        } catch (failed: InternalError) {
            throw noImage(figure, failed)
        }
        return image.toByteArray()
    }

    private fun noImage(figure: Figure, cause: Throwable) = FigureException(
        "cannot draw \"${figure.title}\" as PNG (${cause.message ?: cause.javaClass.simpleName}); " +
            "Java needs fontconfig and one font, such as the package fonts-dejavu-core; SVG needs none",
        cause,
    )
}
