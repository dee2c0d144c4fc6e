package stillwater.cli

/** Options of `map` with something wrong, beside a log that is right, for [MapBadInputTest]. */
internal object BadMapFlags {
    private const val LOG = MapBadInputTest.HEAD + MapBadInputTest.GOOD

    private fun flag(name: String, message: String, vararg flags: String) =
        MapBadInputTest.Case(name, LOG.toByteArray(), message, flags = flags.toList())

    @JvmStatic
    fun all() = listOf(
        flag(
            "crossing of no filter",
            "--filter bounded to go with it, found --filter averaging",
            "--crossing",
            "soft",
            "--filter",
            "averaging",
        ),
        flag(
            "median of no filter",
            "--median: expected --filter bounded or bounded-ex",
            "--median",
            "5",
            "--filter",
            "averaging",
        ),
        flag(
            "calibrate without bounded",
            "--calibrate: expected --filter bounded to go",
            "--calibrate",
            "0:9",
            "--filter",
            "averaging",
        ),
        flag(
            "auto epsilon without bounded",
            "--epsilon: expected --filter bounded to go with it, found --filter averaging",
            "--epsilon",
            "auto",
            "--filter",
            "averaging",
        ),
        flag("no directory", "--out: expected a directory (. for this one), found ''", "--out", ""),
        flag(
            "slowest without interval",
            "--slowest: expected --filter interval to go with it, found the usual --filter averaging,bounded",
            "--slowest",
            "9",
        ),
        flag(
            "condition without sensor",
            "--condition: expected --sensor to go with it, found none",
            "--condition",
            "speed=do_mg_l",
        ),
        flag(
            "pose age of a table",
            "expected a Platypus log for --max-pose-age, found a table",
            "--max-pose-age",
            "9",
        ),
        flag(
            "order of dates without dates",
            "column time_s: expected a date such as 05/06/2025, as --date-order says",
            "--date-order",
            "dmy",
        ),
        flag("cell of 0", "--cell: expected a length in metres above 0, and at most", "--cell", "0"),
        flag("cell NaN", "--cell: expected", "--cell", "NaN"),
        flag(
            "cell wider than the globe",
            "--cell: expected cells of at most 1000 km in a log with latitudes, found 1.0E8 m",
            "--cell",
            "1e8",
        ),
        flag(
            "cell beyond all places",
            "--cell: expected a length in metres above 0, and at most 1000000000, found '1e300'",
            "--cell",
            "1e300",
        ),
        flag("cell too small", "--cell: cells of 1.0E-7 m would make a grid of", "--cell", "0.0000001"),
        flag("cell far too small", "--cell: cells of 1.0E-30 m would make a grid above 16000000", "--cell", "1e-30"),
        flag("grid with one number", "--grid: expected COLSxROWS", "--grid", "10"),
        flag("grid of 0", "--grid: expected COLSxROWS", "--grid", "0x5"),
        flag("grid of halves", "--grid: expected COLSxROWS", "--grid", "1.5x2"),
        flag("grid too fine", "--grid: expected COLSxROWS", "--grid", "100000x100000"),
        flag(
            "grid and cell",
            "--grid: expected either --grid or --cell, found both",
            "--grid",
            "2x2",
            "--cell",
            "5",
        ),
        flag("rotation", "--rotation: expected an angle within -180..180", "--rotation", "181"),
        flag("range", "--range: expected LOW:HIGH", "--range", "9:8"),
        flag("epsilon", "--epsilon: expected auto or a number of at least 0, found '-1'", "--epsilon", "-1"),
        flag("calibrate", "--calibrate: expected FROM:TO", "--calibrate", "60"),
        flag("calibrate on nothing", "expected --calibrate with at least 7 readings", "--calibrate", "100:200"),
        flag(
            "calibrate a number",
            "--calibrate: expected --epsilon auto, found a number",
            "--calibrate",
            "0:1",
            "--epsilon",
            "1",
        ),
        flag("even median", "--median: expected an odd number within 1..999, found '4'", "--median", "4"),
        flag("slope", "--slope: expected a whole number within 2..999, found '1'", "--slope", "1"),
        flag("crossing", "--crossing: expected one of plain, soft, reset, found 'hard'", "--crossing", "hard"),
        flag("filter", "--filter: expected some of averaging, exponential, bounded", "--filter", "kalman"),
        flag("filter twice", "each once", "--filter", "bounded,bounded"),
        flag("unit", "--unit: expected a unit such as mg/L, found ' '", "--unit", " "),
        flag("pose age", "--max-pose-age: expected a number of seconds above 0", "--max-pose-age", "0"),
    )
}
