package stillwater.plot

import kotlin.math.roundToInt

/**
 * The colours of this project's figures, distinguishable with the common kinds of colour blindness.
 *
 * Source: Okabe and Ito, 2008, Color Universal Design, without its yellow, which is too light for a line on white.
 */
internal object Palette {
    val groups = listOf("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")

    const val PAPER = "#FFFFFF"
    const val TEXT = "#222222"
    const val MUTED = "#666666"
    const val GRID = "#E3E6E8"
    const val AXIS = "#8A9096"

    /** Cells or stretches without a value. */
    const val ABSENT = "#D9DCDF"

    /** Differences below, at and above zero, told apart by all. Source: ColorBrewer's RdBu (Brewer and Harrower). */
    const val BELOW = "#2166AC"
    const val LEVEL = "#F7F7F7"
    const val ABOVE = "#B2182B"

    /** [colour], as `#0072B2`, as thin as a band of it is on the paper, if a little stronger for a line to be seen. */
    fun ofBand(colour: String): String = (1..5 step 2).joinToString("", prefix = "#") { at ->
        val part = colour.substring(at, at + 2).toInt(HEX)
        "%02X".format((WHITE - (WHITE - part) * BAND_IN_LEGEND).roundToInt())
    }

    /** The colour of the n-th group (from 0), repeating after the last. */
    fun of(index: Int): String = groups[index % groups.size]

    private const val HEX = 16
    private const val WHITE = 255
    private const val BAND_IN_LEGEND = 0.3
}
