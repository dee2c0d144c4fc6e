package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.nullableFlag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.CrossingPolicy
import stillwater.run.FilterKind

/** The options of the bounded filter besides epsilon; the same for every command that runs it. */
class BoundedFilterOptions : OptionGroup(name = "Bounded filter") {
    private val medianWindow by option("--median", metavar = "N", help = "readings in the median window")
        .wholeNumber("an odd number within 1..$LONGEST_WINDOW") { it in 1..LONGEST_WINDOW && it % 2 == 1 }
    private val slopeWindow by option("--slope", metavar = "N", help = "medians in the slope window")
        .wholeNumber("a whole number within 2..$LONGEST_WINDOW") { it in 2..LONGEST_WINDOW }
    private val crossing by option("--crossing", metavar = "POLICY", help = "bounds that cross: plain, soft or reset")
        .oneOf(CrossingPolicy.entries.associateBy { it.name.lowercase() })
    private val keepWindows by option(
        "--keep-windows",
        help = "keep the windows over cell borders (the report does not say; bounds are then often wrong), or " +
            "clear them on entering a cell",
    ).nullableFlag("--clear-windows")

    /** [settings] with what was given on the command line in their place. */
    fun applied(settings: BoundedFilterSettings): BoundedFilterSettings = settings.copy(
        medianWindow = medianWindow ?: settings.medianWindow,
        slopeWindow = slopeWindow ?: settings.slopeWindow,
        crossing = crossing ?: settings.crossing,
        clearOnEntry = keepWindows?.not() ?: settings.clearOnEntry,
    )

    /** What uses them. */
    internal val users = OptionUsers(
        mapOf(
            "--median" to OptionUser.filters(WINDOWED),
            "--slope" to OptionUser.filters(WINDOWED),
            "--crossing" to OptionUser.filters(BOUNDED),
            "--keep-windows" to OptionUser.filters(BOUNDED),
            "--clear-windows" to OptionUser.filters(BOUNDED),
            // An option of the commands, as its default is theirs.
            "--epsilon" to OptionUser.filters(BOUNDED),
        ),
    )

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> = listOf(
        "--median" to medianWindow,
        "--slope" to slopeWindow,
        "--crossing" to crossing?.name?.lowercase(),
        "--keep-windows" to (keepWindows == true),
        "--clear-windows" to (keepWindows == false),
    )

    private companion object {
        const val LONGEST_WINDOW = 999
        val BOUNDED = listOf(FilterKind.BOUNDED)
        val WINDOWED = BOUNDED + FilterKind.BOUNDED_EXTENDED
    }
}
