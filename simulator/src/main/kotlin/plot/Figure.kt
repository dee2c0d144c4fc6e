package stillwater.plot

/**
 * A finished drawing: one self-contained SVG (no script, no outside font), and the same as PNG on request.
 *
 * The SVG is a function of the input alone: the same data give the same bytes, also when figures are drawn in
 * parallel. PNG bytes depend on the fonts of the machine as well. Immutable.
 *
 * @property title the title as drawn, also the SVG's accessible name.
 * @property svg the document, UTF-8 text without an XML declaration, so that a page can hold it inline.
 * @property width drawn width, CSS px.
 * @property height drawn height, CSS px.
 */
public class Figure internal constructor(
    public val title: String,
    public val svg: String,
    public val width: Int,
    public val height: Int,
) {
    private val image: ByteArray by lazy { PngImage.of(this) }

    /**
     * The figure as a PNG image on white, 2 image px per CSS px.
     *
     * @return the file's bytes. The caller's own copy.
     * @throws FigureException if this machine cannot draw text (a Java without any font).
     */
    public fun png(): ByteArray = image.copyOf()

    /** Makes the PNG now, so that [png] costs nothing; where it cannot be made, [png] says so. */
    internal fun prepare() {
        try {
            image
        } catch (_: FigureException) {
            // Not for this caller to tell.
        }
    }
}

/** A figure that could not be made; the message is one line and says what to do. */
public class FigureException(message: String, cause: Throwable? = null) : RuntimeException(message, cause)
