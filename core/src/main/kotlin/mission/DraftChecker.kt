package stillwater.mission

import stillwater.model.Position
import kotlin.math.ceil
import kotlin.math.floor
import kotlin.math.max

/**
 * What became of a draft.
 *
 * @property spec the mission; null where something is wrong.
 * @property area the water, as soon as that part is right; null before.
 * @property grid the map's cells, as soon as those are; null before.
 * @property problems what is wrong, in one line each; empty where nothing is.
 */
public class DraftCheck internal constructor(
    public val spec: MissionSpec?,
    public val area: AreaSpec?,
    public val grid: GridSpec?,
    public val problems: Map<DraftField, String>,
)

/** Builds a mission's parts one after the other and notes at which field each refuses. */
internal class DraftChecker(private val draft: MissionDraft) {
    private val problems = LinkedHashMap<DraftField, String>()
    private val numbers = DraftField.NUMBERS.associateWith { number(it) }

    fun check(): DraftCheck {
        if (draft.name.isBlank()) problems[DraftField.NAME] = "a mission needs a name"
        val area = part(DraftField.AREA) { area() }
        if (draft.home == null) problems[DraftField.HOME] = "home is not set"
        val grid = area?.let { part(DraftField.CELL) { grid(it) } }
        val probe = part(DraftField.LOWEST) { probe() }
        val budget = part(DraftField.BUDGET) { budget() }
        val boat = part(DraftField.TOP_SPEED) { boat() }
        val failsafe = part(DraftField.LOWEST_VOLTS) { failsafe() }
        val parts = listOf(area, grid, probe, budget, boat, failsafe)
        val spec =
            if (problems.isEmpty() && null !in parts) {
                part(DraftField.PLANNER) { whole(area!!, grid!!, probe!!, budget!!, boat!!, failsafe!!) }
            } else {
                null
            }
        return DraftCheck(spec, area, grid, problems)
    }

    private fun number(field: DraftField): Double? {
        val text = draft.numeral(field)
        if (text.isEmpty()) {
            if (!field.optional) problems[field] = NEEDED[field] ?: "a number is needed here"
            return null
        }
        val number = if (text.all { it in NUMERALS }) text.toDoubleOrNull() else null
        if (number == null || !number.isFinite()) problems[field] = "'$text' is not a number"
        return number?.takeIf { it.isFinite() }
    }

    /** What [build] makes; null, and a problem noted, where it refuses or one of its numbers is missing. */
    private fun <T> part(otherwise: DraftField, build: () -> T?): T? = try {
        build()
    } catch (e: IllegalArgumentException) {
        val words = e.message.orEmpty().lineSequence().first()
        val field = NAMES.entries.firstOrNull { words.startsWith(it.key) }?.value ?: otherwise
        problems.putIfAbsent(field, words)
        null
    }

    private fun area(): AreaSpec? {
        val shore = draft.shore
        if (shore.isEmpty()) {
            problems[DraftField.AREA] = "no corner is set"
            return null
        }
        if (!draft.isRectangle) return AreaSpec(shore = shore, keepOuts = draft.keepOuts)
        require(shore.size == 2) { "a rectangle needs two opposite corners, got ${shore.size}" }
        val southWest = PlaceSpec(shore.minOf { it.x }, shore.minOf { it.y })
        val northEast = PlaceSpec(shore.maxOf { it.x }, shore.maxOf { it.y })
        return AreaSpec(southWest, northEast, keepOuts = draft.keepOuts)
    }

    private fun grid(area: AreaSpec): GridSpec? {
        val cell = numbers[DraftField.CELL] ?: return null
        draft.loaded?.let {
            if (it.area == area && it.grid.cell == cell) {
                MissionDraft.requireDrawable(it)
                return it.grid
            }
        }
        require(cell > 0) { "a cell ($cell m) must be larger than 0" }
        val corners = area.corners()
        val (west, east) = corners.minOf(Position::x) to corners.maxOf(Position::x)
        val (south, north) = corners.minOf(Position::y) to corners.maxOf(Position::y)
        // A rectangle is filled, so that every cell is on the water; a polygon is covered, and its planner keeps to it.
        val columns = max(1.0, whole((east - west) / cell))
        val rows = max(1.0, whole((north - south) / cell))
        MissionDraft.requireDrawable(columns * rows, cell)
        val corner =
            draft.place(Position((west + east - columns * cell) / 2, (south + north - rows * cell) / 2))
        return GridSpec(corner, columns.toInt(), rows.toInt(), cell)
    }

    private fun whole(cells: Double) = if (draft.isRectangle) floor(cells) else ceil(cells)

    private fun probe(): ProbeSpec? {
        val lowest = numbers[DraftField.LOWEST] ?: return null
        val highest = numbers[DraftField.HIGHEST] ?: return null
        val port = wholeNumber(DraftField.PORT, "port")
        val stuckAfter = wholeNumber(DraftField.STUCK_AFTER, "stuck_after")
        val latency = numbers[DraftField.LATENCY] ?: return null
        val slowest = numbers[DraftField.SLOWEST] ?: return null
        val base = draft.loaded?.probe ?: ProbeSpec(draft.quantity, lowest = 0.0, highest = 1.0)
        return base.copy(
            quantity = draft.quantity,
            port = port,
            lowest = lowest,
            highest = highest,
            largestJump = numbers[DraftField.LARGEST_JUMP],
            stuckAfter = stuckAfter,
            latency = latency,
            longestTimeConstant = slowest,
            smallestSlope = numbers[DraftField.SMALLEST_SLOPE],
            readingError = numbers[DraftField.READING_ERROR],
        )
    }

    private fun wholeNumber(field: DraftField, name: String): Int? {
        val number = numbers[field] ?: return null
        require(number == floor(number)) { "$name ($number) must be a whole number" }
        return number.toInt()
    }

    private fun budget(): BudgetSpec? {
        val limit = numbers[DraftField.BUDGET] ?: return null
        val reserve = numbers[DraftField.RESERVE] ?: return null
        val base = draft.loaded?.budget ?: BudgetSpec(metres = 1.0)
        return base.copy(
            metres = limit.takeIf { !draft.isTimed },
            seconds = limit.takeIf { draft.isTimed },
            reserve = reserve,
        )
    }

    private fun boat(): BoatSpec? {
        val topSpeed = numbers[DraftField.TOP_SPEED] ?: return null
        val cruise = numbers[DraftField.CRUISE] ?: return null
        val arrival = numbers[DraftField.ARRIVAL] ?: return null
        return (draft.loaded?.boat ?: BoatSpec()).copy(topSpeed = topSpeed, cruise = cruise, arrival = arrival)
    }

    private fun failsafe(): FailsafePolicy? {
        val volts = numbers[DraftField.LOWEST_VOLTS] ?: return null
        val percent = numbers[DraftField.LOWEST_PHONE] ?: return null
        return (draft.loaded?.failsafe ?: FailsafePolicy()).copy(
            battery = draft.onBattery,
            lowestVolts = volts,
            lowestPhonePercent = percent,
            fence = draft.onFence,
            end = draft.atEnd,
            rearms = draft.rearms,
        )
    }

    private fun whole(
        area: AreaSpec,
        grid: GridSpec,
        probe: ProbeSpec,
        budget: BudgetSpec,
        boat: BoatSpec,
        failsafe: FailsafePolicy,
    ): MissionSpec? {
        val origin = draft.origin ?: return null
        val home = draft.home ?: return null
        val base = draft.loaded
            ?: return MissionSpec(
                draft.name,
                origin,
                area,
                grid,
                probe,
                draft.estimator,
                draft.planner,
                budget,
                home,
                boat,
                failsafe,
            )
        return base.copy(
            name = draft.name,
            origin = origin,
            area = area,
            grid = grid,
            probe = probe,
            estimator = draft.estimator,
            planner = draft.planner,
            budget = budget,
            home = home,
            boat = boat,
            failsafe = failsafe,
        )
    }

    private companion object {
        const val NUMERALS = "0123456789.+-eE"

        /** A boat whose battery nobody watches is a person's choice and never one that nobody made. */
        val NEEDED =
            mapOf(DraftField.LOWEST_VOLTS to "a number is needed here, 0 where the board does not measure its battery")

        /** How a refusal begins, and the field it is about. */
        val NAMES = mapOf(
            "port" to DraftField.PORT,
            "lowestVolts" to DraftField.LOWEST_VOLTS,
            "lowestPhonePercent" to DraftField.LOWEST_PHONE,
            "lowest" to DraftField.LOWEST,
            "largest_jump" to DraftField.LARGEST_JUMP,
            "stuck_after" to DraftField.STUCK_AFTER,
            "smallest_slope_per_s" to DraftField.SMALLEST_SLOPE,
            "reading_error" to DraftField.READING_ERROR,
            "latency_s" to DraftField.LATENCY,
            "longest_time_constant_s" to DraftField.SLOWEST,
            "reserve" to DraftField.RESERVE,
            "cruise" to DraftField.CRUISE,
            "arrival" to DraftField.ARRIVAL,
            "home" to DraftField.HOME,
            "no cell" to DraftField.CELL,
        )
    }
}
