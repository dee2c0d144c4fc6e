package stillwater.io

/**
 * A unit of time, for times that are numbers.
 *
 * @property flag what it is called on the command line. @property seconds in one of it.
 */
enum class TimeUnit(val flag: String, val seconds: Double) {
    /** Thousandths of a second. */
    MILLISECONDS("ms", 1e-3),

    /** Seconds. */
    SECONDS("s", 1.0),

    /** Minutes. */
    MINUTES("min", 60.0),

    /** Hours. */
    HOURS("h", 3600.0),

    /** Days. */
    DAYS("d", 86_400.0),
}
