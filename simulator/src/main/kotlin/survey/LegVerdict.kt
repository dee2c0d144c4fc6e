package stillwater.survey

/**
 * What the paired comparison of legs says about a lag.
 *
 * @property label the verdict in words.
 */
enum class LegVerdict(val label: String) {
    /** Opposite legs disagree more than same-direction ones, by more than two standard errors. */
    LAG_SEEN("lag seen"),

    /** They do not, or not by that much. */
    NOT_TOLD_APART("not told apart from the water's own change this way"),

    /** Too few legs have both kinds of neighbours; a bootstrap over legs says nothing. */
    TOO_FEW_LEGS("too few legs with neighbours of both directions to tell"),
    ;

    internal companion object {
        /** The verdict on [excess], opposite minus same, over [legs] legs. */
        fun of(excess: Estimate?, legs: Int): LegVerdict = when {
            excess == null || legs < LagShift.FEWEST_LEGS -> TOO_FEW_LEGS
            excess.mean > 2 * excess.standardError && excess.mean > 0 -> LAG_SEEN
            else -> NOT_TOLD_APART
        }
    }
}
