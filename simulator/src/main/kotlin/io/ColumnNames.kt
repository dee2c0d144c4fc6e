package stillwater.io

/** Names that loggers and people give to the columns of time and place, without their units and marks. */
internal object ColumnNames {
    private val IN_BRACKETS = Regex("""\(.*?\)|\[.*?]|<.*?>""")
    private val MARKS = Regex("""[^a-z0-9#]+""")

    /** Names of times, those that say most first. */
    private val TIMES = listOf(
        "unix_time", "unix_timestamp", "epoch", "epoch_time", "timestamp", "time_stamp", "datetime", "date_time",
        "date_and_time", "utc_date_time", "utc_datetime", "datetime_utc", "date_time_utc", "time_utc", "utc_time",
        "time", "elapsed_time", "time_sec", "time_seconds", "elapsed_s",
    ) + listOf("unix", "unix_time", "epoch", "timestamp", "time", "elapsed").flatMap { name ->
        listOf("${name}_ms", "${name}_min", "${name}_h")
    } + listOf("unix_s", "epoch_s", "timestamp_s", "unix_time_s", "time_s", "date")
    private val DATES = setOf("date", "utc_date", "date_utc", "local_date", "gps_date")
    private val LATITUDES = setOf(
        "latitude",
        "lat",
        "gps_latitude",
        "gps_lat",
        "latitude_deg",
        "latitude_degrees",
        "lat_degrees",
        "lat_deg",
        "lat_dd",
    )
    private val LONGITUDES = setOf(
        "longitude", "lon", "long", "lng", "gps_longitude", "gps_lon", "gps_long", "gps_lng", "longitude_deg",
        "longitude_degrees", "lon_degrees", "lon_deg", "lon_dd", "long_dd",
    )
    private val EASTS = setOf("x", "easting", "easting_m", "x_m", "x_metres", "x_meters")
    private val NORTHS = setOf("y", "northing", "northing_m", "y_m", "y_metres", "y_meters")
    private val OWN = setOf("time_s", "unix_time_s", "lat_deg", "lon_deg", "x_m", "y_m")
    private val COUNTERS = setOf("#", "record", "record_number", "row")

    /** What Sea-Bird calls times. */
    private val SEA_BIRD = setOf(
        "times", "timem", "timeh", "timej", "timejv2", "timescp", "timek", "timeq", "timen", "timey",
    )

    /** What Sea-Bird calls the count of scans and the mark of bad ones: words that stand in other tables, too. */
    private val SCANS = setOf("scan", "flag")
    private val KNOWN = TIMES.toSet() + DATES + LATITUDES + LONGITUDES + EASTS + NORTHS + COUNTERS + SEA_BIRD

    /** Seconds in the unit at the end of a name, as in `unix_ms`, `Time (min)` and `Time, h`. */
    private val UNITS = listOf(
        Regex("""(?i)(^|[^a-z])(ms|msecs?|millis|milliseconds?)\s*[)\]]?$""") to 1e-3,
        Regex("""(?i)(_|,\s*|[(\[]([^)\]]*\s)?)(min|mins|minutes?)\s*[)\]]?$""") to 60.0,
        Regex("""(?i)(_|,\s*|[(\[]\s*)(h|hr|hrs|hours?)\s*[)\]]?$""") to 3600.0,
        Regex("""(?i)(_days?|(,\s*|[(\[]\s*)(d|days?)\s*[)\]]?)$""") to 86_400.0,
    )
    private val SECONDS =
        Regex("""(?i)((_|,\s*|[(\[]([^)\]]*\s)?)(s|secs?|seconds?)\s*[)\]]?|unix.*|epoch.*)$""")
    private val METRES = Regex("""(?i)m|met(er|re)s?""")
    private val DEGREES =
        Regex("""(?i)(decimal[ _])?(deg(ree)?s?|dd|[°º])([ _.]*(n|e|north|east|dec|decimal))?\.?""")
    private val STATED = Regex("""[(\[<](.*?)[)\]>]|,(.*)""")
    private val DEPTH = Regex("""(depth?|pres|press|pressure|prdm|prsm|prd)([^a-z].*)?|dep[sf]m|z""")
    private val ON_GLOBE = Regex("""(lat|lon|long|lng|latitude|longitude)([^a-z].*)?""")

    /** [name] in small letters, without units in brackets and what follows a comma, parts joined by `_`. */
    fun plain(name: String): String {
        val bare = name.lowercase().replace(IN_BRACKETS, " ").substringBefore(',')
        return bare.replace(MARKS, "_").trim('_')
    }

    /** Columns that may hold the time, of [names]: the first group that has any; empty where none is known. */
    fun times(names: List<String>): List<List<Int>> {
        val plain = names.map { if ("fract" in it.lowercase()) "" else plain(it) }
        return TIMES.map { known -> plain.indices.filter { plain[it] == known } }.filter { it.isNotEmpty() }
    }

    /** Columns that may hold the date, of [names]. */
    fun dates(names: List<String>): List<Int> = indices(names, DATES)

    /** Columns that may hold the latitude. */
    fun latitudes(names: List<String>): List<Int> = indices(names, LATITUDES)

    /** Columns that may hold the longitude. */
    fun longitudes(names: List<String>): List<Int> = indices(names, LONGITUDES)

    /** Columns that may hold metres east; [units] are those that are stated, empty for others. */
    fun easts(names: List<String>, units: List<String>): List<Int> = metres(names, units, EASTS)

    /** Columns that may hold metres north; [units] likewise. */
    fun norths(names: List<String>, units: List<String>): List<Int> = metres(names, units, NORTHS)

    /** Whether [name] is one for a depth or a pressure. */
    fun isDepth(name: String): Boolean = DEPTH.matches(plain(name))

    /** Whether [name] is one for metres east or north, but states another unit. */
    fun isInOtherUnit(name: String): Boolean = plain(name) in EASTS + NORTHS && !isMetres(stated(name))

    /** Whether [name] is one of time, place or row number, which shows that a table has readings. */
    fun isKnown(name: String): Boolean = name in OWN || plain(name) in KNOWN || "fract" in name.lowercase()

    /** Whether no readings are looked for in a column [name]: what [isKnown], and Sea-Bird's scans and their marks. */
    fun isNoReading(name: String): Boolean = isKnown(name) || plain(name) in SCANS

    /** Seconds in the unit that the [name] of a time states; null where it states seconds or none. */
    fun unit(name: String): Double? = UNITS.firstOrNull { it.first.containsMatchIn(name.trim()) }?.second

    /** Whether the [name] of a time states that its numbers are seconds. */
    fun statesSeconds(name: String): Boolean = SECONDS.containsMatchIn(name.trim())

    /** What the [name] of a column has in its first brackets or behind its first comma; empty where it has neither. */
    fun stated(name: String): String {
        val groups = STATED.find(name)?.groupValues.orEmpty().drop(1)
        return groups.firstOrNull { it.isNotBlank() }.orEmpty().trim()
    }

    /** Whether [unit] is metres, or none. */
    fun isMetres(unit: String): Boolean = isNone(unit) || METRES.matches(unit)

    /** Whether [unit] is degrees with decimals, or none. */
    fun isDegrees(unit: String): Boolean = isNone(unit) || DEGREES.matches(unit)

    /** Whether [unit] says nothing. */
    fun isNone(unit: String): Boolean = CellText.isMissing(unit)

    /**
     * A plain x or y beside latitudes or a z may as well be what an accelerometer or a magnetometer measured, unless it
     * says that it is metres.
     */
    private fun metres(names: List<String>, units: List<String>, known: Set<String>): List<Int> {
        val plain = names.map(::plain)
        val hasOthers = plain.any { it == "z" || ON_GLOBE.matches(it) }
        return indices(names, known).filter {
            isMetres(stated(names[it])) && !(hasOthers && plain[it].length == 1 && !METRES.matches(units[it]))
        }
    }

    private fun indices(names: List<String>, known: Set<String>) = names.indices.filter { plain(names[it]) in known }
}
