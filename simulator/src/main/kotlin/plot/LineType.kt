package stillwater.plot

/** How a line is broken, for telling lines apart without colour. */
internal enum class LineType(val pattern: Int) {
    SOLID(1),
    DASHED(2),
    DOTTED(3),
    DASH_DOT(4),
    LONG_DASH(5),
}
