package stillwater.report

import stillwater.plot.Figure
import stillwater.plot.FigureException

/**
 * Writes each figure as `NAME.svg` and `NAME.png`.
 *
 * A machine without fonts cannot draw a PNG; its SVGs are written all the same.
 *
 * @param figures the figures by name, without ending.
 * @return a warning where PNGs are missing; empty otherwise.
 */
public fun OutputDirectory.writeFigures(figures: List<Pair<String, Figure>>): List<String> {
    val warnings = LinkedHashSet<String>()
    for ((name, figure) in figures) {
        write("$name.svg", figure.svg)
        try {
            write("$name.png", figure.png())
        } catch (missing: FigureException) {
            warnings += "no PNG figures: ${missing.message}"
        }
    }
    return warnings.take(1)
}
