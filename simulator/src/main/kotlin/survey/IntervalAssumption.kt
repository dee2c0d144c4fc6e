package stillwater.survey

import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import stillwater.estimate.IntervalFilterSettings
import stillwater.survey.Wording.Companion.digits

/** Where the largest error of a reading, as the interval filter takes it, comes from. */
enum class ErrorOrigin(val label: String) {
    /** The user said so. */
    GIVEN("given"),

    /** The step in which the log's values are rounded; noise is not in it. */
    RESOLUTION("resolution"),

    /** Nobody said, and the log has no step: readings are taken as exact. */
    NONE("none"),
}

/**
 * What must be true of the sensor for the interval filter's bounds to hold the water's value.
 *
 * @property settings the longest time constant and the largest error of a reading, as the filter took them.
 * @property isSlowestGiven whether the user gave the time constant. @property errorOrigin where the error comes from.
 */
class IntervalAssumption(
    val settings: IntervalFilterSettings,
    val isSlowestGiven: Boolean,
    val errorOrigin: ErrorOrigin,
) {
    private val slowest = "a time constant of ${digits(settings.longestTimeConstant)} s"

    /** What the bounds assume, in one sentence; [value] writes a number with its unit. */
    internal fun sentence(value: (Double) -> String): String {
        val given = if (isSlowestGiven) "as given" else "not given, taken"
        val error = when (errorOrigin) {
            ErrorOrigin.GIVEN -> "off by more than ${value(settings.readingError)}, as given"
            ErrorOrigin.RESOLUTION ->
                "off by more than ${value(settings.readingError)}, the step of the log's values, without noise"
            ErrorOrigin.NONE -> "off at all, for no error was given and the values have no step"
        }
        return "bounds hold the water's value if the sensor is no slower than $slowest ($given), no reading is " +
            "$error, and the water is even within a cell"
    }

    /** What to tell a user who has not given all of it; null where all is given. [value] as for [sentence]. */
    internal fun warning(value: (Double) -> String): String? {
        val assumed = listOfNotNull(
            "a sensor no slower than $slowest (--slowest)".takeUnless { isSlowestGiven },
            when (errorOrigin) {
                ErrorOrigin.GIVEN -> null
                ErrorOrigin.RESOLUTION ->
                    "readings off by no more than ${value(settings.readingError)}, the step of the log's values, " +
                        "which leaves no room for noise (--reading-error)"
                ErrorOrigin.NONE -> "readings without any error (--reading-error)"
            },
        )
        if (assumed.isEmpty()) return null
        return "the interval filter's bounds assume what nobody gave: ${assumed.joinToString(" and ")}; where that " +
            "is not so they may miss the water's value"
    }

    /** The same for machines. */
    internal fun json(): JsonObject = buildJsonObject {
        put("longest_time_constant_s", settings.longestTimeConstant)
        put("longest_time_constant_given", isSlowestGiven)
        put("reading_error", settings.readingError)
        put("reading_error_from", errorOrigin.label)
    }
}
