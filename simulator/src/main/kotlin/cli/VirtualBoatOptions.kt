package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.RawOption
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.option
import com.github.ajalt.clikt.parameters.options.validate
import stillwater.io.SquareReach
import stillwater.mission.MissionSpec
import stillwater.model.Interval
import stillwater.run.label
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.virtual.LinkSpec
import stillwater.virtual.PoseSpec
import stillwater.world.BatterySpec
import stillwater.world.Flow
import stillwater.world.WaterKind
import stillwater.world.WorldSettings

/**
 * The options that make a virtual boat and its water; the same for every command that has one.
 *
 * A command has the group by `private val boat by VirtualBoatOptions()`; the mission is then [mission], and the world
 * made of [settings]. [flags] are for writing the command down.
 */
class VirtualBoatOptions : OptionGroup(name = "Virtual boat") {
    private val water by option("--field", metavar = "KIND", help = waterHelp())
        .oneOf(WaterKind.entries.associateBy { it.label })
    private val waterRange by option(
        "--field-range",
        metavar = "LOW,HIGH",
        help = "range of the water at the cells' centres, sensor units; without it the middle 80 % of the mission's",
    ).numberPair(',', "two numbers, the first below the second") { low, high -> low < high }
        .validate { (low, high) ->
            val expected = SquareReach.rangeProblem(low, high) ?: return@validate
            throw BadFlag("--field-range", expected, "'$low,$high'")
        }
    private val waterSeed by option(
        "--field-seed",
        metavar = "N",
        help = "where the water comes from, instead of --seed",
    ).convert { text -> text.toLongOrNull() ?: throw BadFlag(name, "a whole number", "'$text'") }

    /** Where all chance comes from. */
    val seed: Long by option(
        "--seed",
        metavar = "N",
        help = "where all chance comes from; the same seed, the same bytes",
    ).convert { text -> text.toLongOrNull() ?: throw BadFlag(name, "a whole number", "'$text'") }.default(1)
    private val sensor by option(
        "--sensor",
        metavar = "FILE",
        help = "sensor spec (JSON) of the probe; without it a first-order lag of 10 s with noise of 0.002 of the range",
    )
    private val probePeriod by option(
        "--probe-period",
        metavar = "S",
        help = "time between readings, s (3, as on firmware 4.2.0; older boards 0.5)",
    )
        .number("a number within 0.1..600") { it in SHORTEST..LONGEST_PERIOD }
    private val wind by option("--wind", metavar = "EAST,NORTH", help = "velocity of the air, m/s").flow()
    private val current by option("--current", metavar = "EAST,NORTH", help = "velocity of the water, m/s").flow()
    private val currentTurn by option(
        "--current-turn",
        metavar = "S",
        help = "time in which the --current turns once round, s; without it it does not",
    ).number("a number above 0") { it > 0 }
    private val fixError by option("--fix-error", metavar = "M", help = "standard deviation of a position fix, m (1.5)")
        .number("a number within 0..1000") { it in 0.0..FARTHEST }
    private val fixWander by option(
        "--fix-wander",
        metavar = "M",
        help = "standard deviation of the error that fixes of a minute share, m (0)",
    ).number("a number within 0..1000") { it in 0.0..FARTHEST }
    private val fixPeriod by option("--fix-period", metavar = "S", help = "time between position fixes, s (1)")
        .number("a number within 0.02..600") { it in TICK..LONGEST_PERIOD }
    private val linkDelay by option("--link-delay", metavar = "S", help = "delay of every byte, s (0.02)")
        .number("a number within 0..600") { it in 0.0..LONGEST_PERIOD }
    private val linkLoss by option("--link-loss", metavar = "P", help = "probability that a byte is lost (0)")
        .number("a number within 0..1") { it in 0.0..1.0 }
    private val linkCorruption by option(
        "--link-corruption",
        metavar = "P",
        help = "probability that a byte is changed (0)",
    ).number("a number within 0..1") { it in 0.0..1.0 }
    private val firmware by option("--firmware", metavar = "NAME", help = firmwareHelp())
        .oneOf(Firmware.entries.associateBy { it.label })
    private val watchdog by option("--watchdog", metavar = "S", help = "of the board, s (the firmware's own)")
        .number("a number above 0") { it > 0 }
    private val arming by option("--arming", metavar = "S", help = "time that the board takes to arm, s (4.2)")
        .number("a number above 0") { it > 0 }
    private val volts by option("--battery-volts", metavar = "V", help = "of the full battery, V (15.3)")
        .number("a number above 0") { it > 0 }
    private val capacity by option(
        "--battery-capacity",
        metavar = "WH",
        help = "energy in the battery, W h (300); its voltage falls to 5/6 of the full one when it is used, and " +
            "then the motors stop",
    ).number("a number above 0") { it > 0 }
    private val vectored by vectoredFlag()

    /** What uses them. */
    internal val users = OptionUsers(mapOf("--current-turn" to OptionUser.option("--current")))

    /** The [mission] with the boat that the options ask for. */
    fun mission(mission: MissionSpec): MissionSpec = mission.vectoredWhere(vectored)

    /**
     * What the virtual world is made of.
     *
     * @throws BadFlag if the sensor's file cannot be used, or nothing uses an option.
     */
    fun settings(): WorldSettings {
        users.require(flags(), if (current == null) emptyList() else OptionUser.option("--current"))
        val pose = PoseSpec()
        val link = LinkSpec()
        val board = BoardSpec(firmware ?: Firmware.V4_2)
        val battery = BatterySpec()
        return WorldSettings(
            seed = seed,
            water = water ?: WaterKind.GAUSSIAN,
            waterRange = waterRange?.let { (low, high) -> Interval(low, high) },
            waterSeed = waterSeed,
            sensor = sensor?.let(SensorFile::read),
            wind = wind ?: Flow.NONE,
            current = current ?: Flow.NONE,
            currentTurn = currentTurn ?: Double.POSITIVE_INFINITY,
            pose = pose.copy(
                fixPeriod = fixPeriod ?: pose.fixPeriod,
                fixDeviation = fixError ?: pose.fixDeviation,
                wander = fixWander ?: pose.wander,
            ),
            link = LinkSpec(linkDelay ?: link.delay, linkLoss ?: link.loss, linkCorruption ?: link.corruption),
            board = board.copy(
                watchdog = watchdog ?: board.watchdog,
                arming = arming ?: board.arming,
                oxygenPeriod = probePeriod ?: board.oxygenPeriod,
                volts = volts ?: board.volts,
            ),
            battery = battery.copy(capacity = capacity ?: battery.capacity),
        )
    }

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> = listOf(
        "--field" to water?.label,
        "--field-range" to waterRange?.let { (low, high) -> "$low,$high" },
        "--field-seed" to waterSeed,
        "--seed" to seed,
        "--sensor" to sensor,
        "--probe-period" to probePeriod,
        "--wind" to wind?.let { "${it.east},${it.north}" },
        "--current" to current?.let { "${it.east},${it.north}" },
        "--current-turn" to currentTurn,
        "--fix-error" to fixError,
        "--fix-wander" to fixWander,
        "--fix-period" to fixPeriod,
        "--link-delay" to linkDelay,
        "--link-loss" to linkLoss,
        "--link-corruption" to linkCorruption,
        "--firmware" to firmware?.label,
        "--watchdog" to watchdog,
        "--arming" to arming,
        "--battery-volts" to volts,
        "--battery-capacity" to capacity,
        "--vectored" to vectored,
    )

    private fun RawOption.flow() = convert { text ->
        val numbers = text.split(',').map { it.toDoubleOrNull() ?: Double.NaN }
        // Faster than any water or storm is a slip.
        if (numbers.size != 2 || numbers.any { !(it in -FASTEST..FASTEST) }) {
            throw BadFlag(name, "velocities east and north within -100..100 m/s, such as 0.3,-0.1", "'$text'")
        }
        Flow(numbers[0], numbers[1])
    }

    private companion object {
        const val SHORTEST = 0.1
        const val LONGEST_PERIOD = 600.0
        const val FARTHEST = 1000.0
        const val FASTEST = 100.0

        /** Of the virtual boat, s. */
        const val TICK = 0.02

        fun firmwareHelp() =
            "of the board: v4.2.0 (the default), which has to be told to arm and what is on its port " +
                "and waits 3 s for a command, or master, the branch before it, which arms itself and waits 0.5 s"

        fun waterHelp() = "water: uniform (each cell its own value), gaussian (the default) or smooth (which changes " +
            "within a cell)"
    }
}
