package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.multiple
import com.github.ajalt.clikt.parameters.options.option
import stillwater.io.DateOrder
import stillwater.io.LogChoice
import stillwater.io.TimeUnit

/** The options that say what to take from a log; the same for every command that reads one. */
class LogOptions : OptionGroup(
    name = "What to read",
    help = "A CSV survey needs a header line; what a logger writes before it is passed over. Columns time_s or " +
        "unix_time_s, lat_deg and lon_deg, or x_m and y_m, and the names that loggers use (Date Time, Latitude) are " +
        "recognised; all others are taken by name. docs/logs.md has the whole list. Sea-Bird's .cnv and Platypus " +
        "logs (4.0.0, 4.1.0, 4.2.0) are recognised by content.",
) {
    private val time by option(
        "--time",
        metavar = "COLUMN",
        help = "column with the time: seconds, 2025-06-01T12:00:00Z, a date with the time of day, or a time of day",
    )
    private val date by option(
        "--date",
        metavar = "COLUMN",
        help = "column with the date, where the time is a time of day; found by its name without it",
    )
    private val dateOrder by option(
        "--date-order",
        metavar = DateOrder.entries.joinToString("|") { it.flag },
        help = "order of day, month and year in dates such as 05/06/2025; needed where no date in the log shows it",
    ).oneOf(DateOrder.entries.associateBy { it.flag }, "dmy, mdy or ymd")
    private val timeUnit by option(
        "--time-unit",
        metavar = TimeUnit.entries.joinToString("|") { it.flag },
        help = "unit of times that are numbers; without it the name or the line of units says it, or they are seconds",
    ).oneOf(TimeUnit.entries.associateBy { it.flag }, "ms, s, min, h or d")
    private val overnight by option(
        "--overnight",
        metavar = "HOURS",
        help = "times of day without a date: a step back by so many hours or more begins the next day; without it " +
            "one from 18:00 or later to 06:00 or earlier",
    ).number("a number of hours above 0 and below 24") { it > 0 && it < DAY_HOURS }
    private val latitude by option("--lat", metavar = "COLUMN", help = "column with the latitude in degrees")
    private val longitude by option("--lon", metavar = "COLUMN", help = "column with the longitude in degrees")
    private val x by option(
        "--x",
        metavar = "COLUMN",
        help = "column with metres east; without --y, the place along a transect or profile in any unit",
    )
    private val y by option("--y", metavar = "COLUMN", help = "column with metres north")
    private val values by option(
        "--value",
        metavar = "COLUMN",
        help = "column with the readings; in a Platypus log the sensor, TYPE[#CHANNEL][.FIELD], such as ATLAS_DO " +
            "or ES2.temp. Not needed where there is only one",
    ).multiple()
    private val skipBadRows by option(
        "--skip-bad-rows",
        help = "leave out rows that cannot be used and count them by reason; without it the first is an error",
    ).flag()
    private val maxPoseAge by option(
        "--max-pose-age",
        metavar = "SECONDS",
        help = "Platypus logs: longest time between a reading and the poses it is placed by; " +
            "${LogChoice.USUAL_POSE_AGE} unless given",
    ).number("a number of seconds above 0") { it > 0 }

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> = listOf(
        "--time" to time,
        "--date" to date,
        "--date-order" to dateOrder?.flag,
        "--time-unit" to timeUnit?.flag,
        "--overnight" to overnight,
        "--lat" to latitude,
        "--lon" to longitude,
        "--x" to x,
        "--y" to y,
    ) + values.map { "--value" to it } + listOf(
        "--skip-bad-rows" to skipBadRows,
        "--max-pose-age" to maxPoseAge,
    )

    /** The options as the readers take them. */
    fun choice(): LogChoice {
        if (values.size > 1) throw BadFlag("--value", "one column", values.joinToString(" and "))
        return choices().single()
    }

    /** As [choice], one for each column of readings that is named; one where none is. */
    fun choices(): List<LogChoice> {
        if (values.distinct().size != values.size) {
            throw BadFlag("--value", "each column once", values.joinToString(" and "))
        }
        return values.ifEmpty { listOf(null) }.map(::choiceOf)
    }

    private fun choiceOf(value: String?) = LogChoice(
        time = time,
        latitude = latitude,
        longitude = longitude,
        x = x,
        y = y,
        value = value,
        skipBadRows = skipBadRows,
        maxPoseAge = maxPoseAge,
        date = date,
        dateOrder = dateOrder,
        timeUnit = timeUnit,
        overnight = overnight?.let { it * HOUR },
    )

    private companion object {
        const val DAY_HOURS = 24
        const val HOUR = 3600.0
    }
}
