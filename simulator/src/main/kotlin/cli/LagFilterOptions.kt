package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.option
import stillwater.run.FilterKind
import stillwater.run.LagFilterSettings
import stillwater.sensor.SensorSpec

/** The options of the filters that reckon with a lag; the same for every command that runs them. */
class LagFilterOptions : OptionGroup(name = "Interval filter, self-calibrating estimator, extended bounded filter") {
    private val slowest by option(
        "--slowest",
        metavar = "SECONDS",
        help = "interval: the longest time constant that the sensor may have",
    ).number(TIME) { it > 0 && it <= SensorSpec.LONGEST_TIME }
    private val readingError by option(
        "--reading-error",
        metavar = "NUMBER",
        help = "interval: the most a reading may be off for noise and resolution",
    ).number("a number of at least 0") { it >= 0 }
    private val timeConstant by option(
        "--time-constant",
        metavar = "SECONDS",
        help = "self-calibrating and bayesian: a first guess at the sensor's time constant",
    ).number(TIME) { it > 0 && it <= SensorSpec.LONGEST_TIME }
    private val factor by option(
        "--factor",
        metavar = "NUMBER",
        help = "self-calibrating and bayesian: the factor by which that guess may be wrong",
    ).number("a number above 1") { it > 1 }

    private val response by option(
        "--response",
        metavar = "HOW",
        help = "bounded-extended: distances per slope are learned, or none: bounds from the direction alone",
    ).oneOf(RESPONSES)

    /** Whether the longest time constant was given. */
    val slowestGiven: Boolean get() = slowest != null

    /** Whether the largest error of a reading was given. */
    val readingErrorGiven: Boolean get() = readingError != null

    /** [settings] with what was given on the command line in their place. */
    fun applied(settings: LagFilterSettings): LagFilterSettings = settings.copy(
        interval = settings.interval.copy(
            longestTimeConstant = slowest ?: settings.interval.longestTimeConstant,
            readingError = readingError ?: settings.interval.readingError,
        ),
        selfCalibrating = settings.selfCalibrating.copy(
            timeConstant = timeConstant ?: settings.selfCalibrating.timeConstant,
            factor = factor ?: settings.selfCalibrating.factor,
        ),
        learnsResponse = response ?: settings.learnsResponse,
    )

    /** What uses them. */
    internal val users = OptionUsers(
        mapOf(
            "--slowest" to OptionUser.filters(listOf(FilterKind.INTERVAL)),
            "--reading-error" to OptionUser.filters(listOf(FilterKind.INTERVAL)),
            "--time-constant" to OptionUser.filters(LEARNING),
            "--factor" to OptionUser.filters(LEARNING),
            "--response" to OptionUser.filters(listOf(FilterKind.BOUNDED_EXTENDED)),
        ),
    )

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> = listOf(
        "--slowest" to slowest,
        "--reading-error" to readingError,
        "--time-constant" to timeConstant,
        "--factor" to factor,
        "--response" to RESPONSES.entries.find { it.value == response }?.key,
    )

    private companion object {
        const val TIME = "a time in seconds above 0, and at most ${SensorSpec.LONGEST_TIME} (32 years)"
        val LEARNING = listOf(FilterKind.SELF_CALIBRATING, FilterKind.BAYESIAN)
        val RESPONSES = mapOf("learned" to true, "none" to false)
    }
}
