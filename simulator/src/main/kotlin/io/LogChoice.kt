package stillwater.io

/**
 * What to take from a log, and how strict to be.
 *
 * Names of columns are the log's own; null stands for the recognised ones (`time_s`, `unix_time_s`, `lat_deg`,
 * `lon_deg`, `x_m`, `y_m` and those of [ColumnNames]).
 *
 * @property time column with the time, s or ISO 8601.
 * @property timeUnit unit of times that are numbers; null where the log must show it.
 * @property overnight least step back, s, after which times of day without a date are the next day's; null for one
 *   from 18:00 or later to 06:00 or earlier.
 * @property date column with the date, where [time] is a time of day.
 * @property dateOrder order of day, month and year in dates of numbers; null where the log must show it.
 * @property latitude column with the latitude, degrees north.
 * @property longitude column with the longitude, degrees east.
 * @property x column with the distance east or along a transect, m.
 * @property y column with the distance north, m; may be left out where [x] is given, and where no place is needed.
 * @property value column with the readings, or sensor TYPE[#CHANNEL][.FIELD] of a Platypus log.
 * @property conditions column of each further quantity, by the name it is to have.
 * @property skipBadRows whether rows that cannot be used are counted and left out rather than an error.
 * @property needsPlace whether a log without places is an error; else all its readings are at 0, 0.
 * @property maxPoseAge longest time between a reading and a pose it is placed by, s, above 0; null for [USUAL_POSE_AGE].
 *   Platypus logs only: in a table each reading has its place.
 * @property keepsUnread whether rows that lack the reading alone are handed on, with NaN, before the next that has one;
 *   they are counted as left out all the same. Tables only.
 * @throws IllegalArgumentException if [maxPoseAge] or [overnight] is out of its range.
 */
data class LogChoice(
    val time: String? = null,
    val latitude: String? = null,
    val longitude: String? = null,
    val x: String? = null,
    val y: String? = null,
    val value: String? = null,
    val conditions: Map<String, String> = emptyMap(),
    val skipBadRows: Boolean = false,
    val needsPlace: Boolean = true,
    val maxPoseAge: Double? = null,
    val date: String? = null,
    val dateOrder: DateOrder? = null,
    val timeUnit: TimeUnit? = null,
    val overnight: Double? = null,
    val keepsUnread: Boolean = false,
) {
    init {
        require(maxPoseAge == null || (maxPoseAge > 0 && maxPoseAge.isFinite())) {
            "maxPoseAge ($maxPoseAge s) must be above 0 and finite"
        }
        require(overnight == null || (overnight > 0 && overnight < DAY)) {
            "overnight ($overnight s) must be above 0 and below a day"
        }
    }

    /** Names of all columns that it names. */
    internal val named: Set<String>
        get() = listOfNotNull(time, date, latitude, longitude, x, y, value).toSet() + conditions.values

    /** The first flag given that says how a column's times are to be read, or null. */
    internal val timing: String?
        get() = listOf("--date-order" to dateOrder, "--time-unit" to timeUnit, "--overnight" to overnight)
            .firstOrNull { it.second != null }?.first

    companion object {
        /** Longest time between a reading and a pose it is placed by, unless said otherwise, s. */
        const val USUAL_POSE_AGE: Double = 2.0

        private const val DAY = 86_400.0
    }
}
