package stillwater.io

/**
 * Which columns of a survey CSV hold what; indices into its header.
 *
 * @property names the header.
 * @property time column with the time.
 * @property date column with the date where [time] is a time of day, or [NONE].
 * @property latitude column with the latitude, or [NONE] where positions are in metres.
 * @property longitude column with the longitude, or [NONE].
 * @property x column with metres east, or [NONE] where positions are in degrees or there are none.
 * @property y column with metres north, or [NONE] where there is only x.
 * @property value column with the readings.
 * @property conditions columns of further quantities by name.
 */
internal data class CsvColumns(
    val names: List<String>,
    val time: Int,
    val date: Int,
    val latitude: Int,
    val longitude: Int,
    val x: Int,
    val y: Int,
    val value: Int,
    val conditions: Map<String, Int>,
) {
    /** Columns that were recognised by names other than Stillwater's own, for people. */
    fun notes(): List<String> = buildList {
        val place = listOf(latitude, longitude, x, y).filter { it != NONE }.map { names[it] }
        if (place.any { it !in RECOGNISED }) add("places from ${place.joinToString(" and ")}")
        if (names[time] !in RECOGNISED && date == NONE) add("times from ${names[time]}")
    }

    companion object {
        const val NONE = -1
        private val TIMES = listOf("time_s", "unix_time_s")

        /** Latitude, degrees north. */
        const val LATITUDE = "lat_deg"

        /** Longitude, degrees east. */
        const val LONGITUDE = "lon_deg"
        private const val X = "x_m"
        private const val Y = "y_m"
        private val RECOGNISED = TIMES + listOf(LATITUDE, LONGITUDE, X, Y)

        /** [header] with a number behind names that come several times, `temp#1` and `temp#2`. */
        fun distinct(header: List<String>): List<String> {
            val counts = header.groupingBy { it }.eachCount()
            val seen = HashMap<String, Int>()
            return header.map { name ->
                if (name.isEmpty() || counts.getValue(name) == 1) name else "$name#${seen.merge(name, 1, Int::plus)}"
            }
        }

        /**
         * The columns that [choice] means in a log with the header [names], which differ.
         *
         * @param layout how it is written: its first row tells columns of numbers from others.
         * @param problem makes the error for column (or null), expected, found.
         */
        fun of(
            names: List<String>,
            layout: CsvLayout,
            choice: LogChoice,
            problem: (String?, String, String) -> LogProblem,
        ): CsvColumns = Finder(names, layout, choice, problem).columns()

        /** Columns of the positions, [NONE] where they have no such column. */
        private class Place(val latitude: Int, val longitude: Int, val x: Int, val y: Int) {
            val columns = listOf(latitude, longitude, x, y)

            /** Whether that is what [choice] needs: degrees, metres, x alone where it was named, or no place at all. */
            fun suffices(choice: LogChoice): Boolean = when {
                latitude == NONE && x == NONE && y == NONE -> !choice.needsPlace
                latitude != NONE -> true
                else -> x != NONE && (y != NONE || choice.x != null)
            }
        }

        /** What is missing where one of latitude and longitude was named alone. */
        private fun LogChoice.halfAPlace(): String? = when {
            latitude != null -> "--lon with --lat, or a column lon_deg"
            longitude != null -> "--lat with --lon, or a column lat_deg"
            else -> null
        }

        private val LogChoice.namesDegrees: Boolean get() = latitude != null || longitude != null

        /** A column that serves more than one purpose, and how many; null where there is none. */
        private fun usedTwice(columns: List<Int>): Pair<Int, Int>? =
            columns.filter { it != NONE }.groupingBy { it }.eachCount().entries.firstOrNull { it.value > 1 }?.toPair()
    }

    /** Finds the columns that [choice] means; see [of]. */
    private class Finder(
        private val names: List<String>,
        private val layout: CsvLayout,
        private val choice: LogChoice,
        private val problem: (String?, String, String) -> LogProblem,
    ) {
        private val sample = layout.sample

        /** What a column says of its unit, in its name or below it. */
        private val units = names.mapIndexed { i, name -> ColumnNames.stated(name).ifEmpty { layout.unit(i) } }

        fun columns(): CsvColumns {
            val time = choice.time?.let(::named)
                ?: TIMES.map { recognised(it) }.firstOrNull { it != NONE }
                ?: knownTime()
            val date = date(time)
            val place = place()
            val conditions = choice.conditions.mapValues { (_, name) -> named(name) }
            choice.conditions.values.firstOrNull { named(it) == time || named(it) == date }?.let { name ->
                throw problem(name, "another column than the time's as reference or condition", "the time's")
            }
            val used = place.columns.toSet() + time + date + conditions.values
            val value = choice.value?.let(::named) ?: onlyCandidate(used)
            usedTwice(place.columns + time + date + value)?.let { (column, uses) ->
                throw problem(names[column], "one use of it as time, position or readings", "$uses")
            }
            return CsvColumns(names, time, date, place.latitude, place.longitude, place.x, place.y, value, conditions)
        }

        private val all: String get() = "columns ${listed(names)}"

        private fun named(name: String): Int {
            val index = names.indexOf(name)
            if (index >= 0) return index
            val twins = names.filter { it.startsWith("$name#") }
            if (twins.size > 1) throw problem(name, "one of ${twins.joinToString(", ")}", "several such columns")
            val near = NearName.of(name, names)?.let { "; did you mean '$it'?" }.orEmpty()
            throw problem(name, "one of ${listed(names)}", "no such column$near")
        }

        private fun recognised(name: String, others: List<Int> = emptyList()): Int = when {
            name in names || names.any { it.startsWith("$name#") } -> named(name)
            else -> others.singleOrNull() ?: NONE
        }

        /** The column with the time by the names that loggers use. */
        private fun knownTime(): Int {
            val known = ColumnNames.times(names)
            for (columns in known) {
                // Of several, those with a time and not a number.
                val texts = columns.filter { CellText.isTime(sample.getOrNull(it).orEmpty()) }
                (columns.singleOrNull() ?: texts.singleOrNull())?.let { return it }
            }
            if (known.isEmpty()) throw problem(null, "a column time_s or unix_time_s, or --time COLUMN", all)
            val several = known.first().joinToString(", ") { names[it] }
            throw problem(null, "--time with one of $several", "${known.first().size} columns that could hold the time")
        }

        private fun date(time: Int): Int = when {
            choice.date != null -> named(choice.date)
            DateText.ofDay(sample.getOrNull(time).orEmpty()).isNaN() -> NONE
            else -> ColumnNames.dates(names).firstOrNull { it != time } ?: NONE
        }

        private fun place(): Place {
            val inMetres = choice.x != null || choice.y != null
            if (inMetres && choice.namesDegrees) throw problem(null, "--lat and --lon or --x and --y", "some of both")
            val place = (if (inMetres) null else degrees()) ?: metres()
            val other = names.firstOrNull { ColumnNames.isInOtherUnit(it) }
            if (choice.needsPlace && place.columns.all { it == NONE } && other != null) {
                throw problem(other, "metres, or --x and --y", all)
            }
            if (place.suffices(choice) || isLine(place)) return place
            val expected = "columns lat_deg and lon_deg, or x_m and y_m, or --lat and --lon, or --x" + placeHint()
            throw problem(null, expected, all)
        }

        /** Whether [place] is a distance along a line alone, where none is needed at all. */
        private fun isLine(place: Place) =
            !choice.needsPlace && place.latitude == NONE && place.y == NONE && names.getOrNull(place.x) == X

        /** What may be meant by columns that are not taken for places without being asked. */
        private fun placeHint(): String {
            val x = names.firstOrNull { ColumnNames.plain(it) == "x" }
            val y = names.firstOrNull { ColumnNames.plain(it) == "y" }
            val depth = names.firstOrNull { ColumnNames.isDepth(it) }
            return when {
                x != null && y != null -> " (--x '$x' --y '$y' if these are metres)"
                X in names -> " (--x '$X' for a transect)"
                depth != null -> " (--x '$depth' for a profile)"
                else -> " (without places: diagnose or correct with --reference, or correct with --sensor)"
            }
        }

        private fun degrees(): Place? {
            val latitude = choice.latitude?.let(::named) ?: recognised(LATITUDE, ColumnNames.latitudes(names))
            val longitude = choice.longitude?.let(::named) ?: recognised(LONGITUDE, ColumnNames.longitudes(names))
            return if (latitude == NONE || longitude == NONE) null else Place(latitude, longitude, NONE, NONE)
        }

        private fun metres(): Place {
            choice.halfAPlace()?.let { throw problem(null, it, "neither") }
            val x = choice.x?.let(::named) ?: recognised(X, ColumnNames.easts(names, units))
            val y = choice.y?.let(::named)
                ?: if (choice.x == null) recognised(Y, ColumnNames.norths(names, units)) else NONE
            return Place(NONE, NONE, x, y)
        }

        private fun onlyCandidate(used: Set<Int>): Int {
            val candidates = names.indices.filter { it !in used && isCandidate(it) }
            candidates.singleOrNull()?.let { return it }
            if (candidates.isEmpty()) throw problem(null, "a column with readings", all)
            val which = "--value with one of ${candidates.joinToString(", ") { names[it] }}"
            throw problem(null, which, "${candidates.size} columns that could hold the readings")
        }

        private fun isCandidate(index: Int): Boolean {
            // A separator at the end of the lines makes a column without a name, as a program's own index does.
            if (names[index].isEmpty()) return false
            val field = sample.getOrNull(index).orEmpty()
            val isNumeric = CellText.isMissing(field) || CellText.isNumber(field, comma = true)
            return isNumeric && names[index] !in RECOGNISED && !ColumnNames.isNoReading(names[index])
        }
    }
}
