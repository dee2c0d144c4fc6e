package stillwater.diagnose

/** Logs without a reference that nothing can be told from, however they are looked at. */
internal object TooLittle {
    private const val FEWEST_ROWS = 60
    private const val SMALLEST_RANGE = 1e-100

    /** Why [series] cannot show anything, or null where it may. */
    fun why(series: MeasuredSeries): String? = when {
        series.size < FEWEST_ROWS -> "there are ${series.size} rows only"
        isFlat(series.values) -> "the readings never change"
        series.values.max() - series.values.min() < SMALLEST_RANGE ->
            "the readings change by less than can be reckoned with"
        isFlat(series.x) && isFlat(series.y) ->
            "the boat never moves, so that no pass comes back to the same water"
        else -> null
    }
}
