package stillwater.survey

import stillwater.model.Interval

/** The range that is taken for the water's values where none is given. */
internal object WaterRange {
    private const val MARGIN = 0.1
    private const val MARGIN_OF_NOTHING = 0.5

    /** The readings' range and a tenth of it more either way: a slow sensor falls short of the water's extremes. */
    fun ofReadings(statistics: SurveyStatistics): Interval = withMargin(statistics.lowest, statistics.highest)

    /** [taken], widened to hold what is [known] of the water's range and a tenth more; null where it holds that. */
    fun wider(taken: Interval, known: Interval?): Interval? {
        if (known == null || (known.lower >= taken.lower && known.upper <= taken.upper)) return null
        val wanted = withMargin(known.lower, known.upper)
        return Interval(minOf(taken.lower, wanted.lower), maxOf(taken.upper, wanted.upper))
    }

    private fun withMargin(lowest: Double, highest: Double): Interval {
        val span = highest - lowest
        val margin = if (span > 0) MARGIN * span else MARGIN_OF_NOTHING
        return Interval(lowest - margin, highest + margin)
    }
}
