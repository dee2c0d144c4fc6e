package stillwater.io

/** How fast the boat goes in the first rows of a log, if its times are seconds. */
internal object HeadSpeed {
    private const val FEWEST_STRETCHES = 5
    private const val LONGEST_STRETCH = 20

    /**
     * The median of the speeds over stretches of rows whose times grow, m/s; 0 where there are none. Stretches, because
     * a fix of few decimals stands for many rows and then jumps.
     */
    fun of(layout: CsvLayout, columns: CsvColumns): Double {
        val places = HeadPlaces.of(columns, layout::numbers) ?: return 0.0
        val times = layout.numbers(columns.time)
        val rows = times.indices.filter { times[it].isFinite() && places.isPlace(it) }
        val stretch = (rows.size / FEWEST_STRETCHES).coerceIn(1, LONGEST_STRETCH)
        val ends = rows.filterIndexed { k, _ -> k % stretch == 0 }
        val speeds = ends.zipWithNext { a, b -> places.metres(a, b) / (times[b] - times[a]) }
            .filter { it >= 0 && it.isFinite() }.sorted()
        return if (speeds.isEmpty()) 0.0 else speeds[speeds.size / 2]
    }
}
