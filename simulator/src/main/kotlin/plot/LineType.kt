package stillwater.plot

/** How a line is broken, for telling lines apart without colour. */
public enum class LineType(internal val pattern: Int) {
    SOLID(1),
    DASHED(2),
    DOTTED(3),
    DASH_DOT(4),
    LONG_DASH(5),
    ;

    internal companion object {
        /** The type of the n-th group (from 0), repeating after the last. */
        fun of(index: Int): LineType = entries[index % entries.size]
    }
}
