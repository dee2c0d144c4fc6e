package stillwater.plot

/** How an axis turns numbers into lengths. */
public enum class AxisScale {
    LINEAR,

    /** Decimal logarithm. Numbers that are not positive are left out; with none left the axis falls back to linear. */
    LOG10,
}
