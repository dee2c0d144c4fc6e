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

    /** They do, but those one way lie to one side of those the other way, where the water may differ by as much. */
    ASIDE("not told: legs one way lie to one side of those the other way, in other water"),

    /** Too few legs have both kinds of neighbours; a bootstrap over legs says nothing. */
    TOO_FEW_LEGS("too few legs with neighbours of both directions to tell"),
    ;

    internal companion object {
        /** The verdict on [excess], opposite minus same, over [legs] legs, of which [aside] may be the water's own. */
        fun of(excess: Estimate?, legs: Int, aside: Double = 0.0): LegVerdict = when {
            excess == null || legs < LagShift.FEWEST_LEGS -> TOO_FEW_LEGS
            !(excess.mean > 2 * excess.standardError && excess.mean > 0) -> NOT_TOLD_APART
            aside >= excess.mean -> ASIDE
            else -> LAG_SEEN
        }
    }
}
