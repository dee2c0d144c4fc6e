package stillwater.mission

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import kotlinx.serialization.json.Json
import stillwater.control.Danger
import stillwater.control.Failsafe
import stillwater.control.FollowerSettings
import stillwater.control.Mixing
import stillwater.control.SafetySettings
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.JsonForm
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.plan.WaterRoutes
import kotlin.math.abs

/** A place as JSON has it, in metres [x] east and [y] north of the mission's origin. */
@Serializable
public data class PlaceSpec(@SerialName("x_m") val x: Double, @SerialName("y_m") val y: Double) {
    init {
        require(reaches(Position(x, y))) {
            "x_m, y_m ($x, $y) must be within $FARTHEST m of the origin"
        }
    }

    /** The same in the local frame. */
    public val position: Position get() = Position(x, y)

    public companion object {
        private const val FARTHEST = 100_000.0

        /** Whether [position], m from a mission's origin, is near enough to be a place of that mission. */
        public fun reaches(position: Position): Boolean = abs(position.x) <= FARTHEST && abs(position.y) <= FARTHEST
    }
}

/** Where the mission's frame has its zero, degrees, WGS-84. */
@Serializable
public data class OriginSpec(
    @SerialName("lat_deg") val latitude: Double,
    @SerialName("lon_deg") val longitude: Double,
) {
    init {
        LatLon(latitude, longitude)
        require(LocalFrame.canStartAt(latitude)) { "lat_deg ($latitude) must not be at a pole" }
    }
}

/**
 * The water that the boat may be on: a rectangle between two corners, or a polygon.
 *
 * @property southWest corner of a rectangle, with [northEast]; null for a polygon.
 * @property shore corners of a polygon in order; null for a rectangle.
 * @property keepOuts outlines within that are kept out of.
 */
@Serializable
public data class AreaSpec(
    @SerialName("south_west") val southWest: PlaceSpec? = null,
    @SerialName("north_east") val northEast: PlaceSpec? = null,
    val shore: List<PlaceSpec>? = null,
    @SerialName("keep_outs") val keepOuts: List<List<PlaceSpec>> = emptyList(),
) {
    init {
        val isRectangle = southWest != null && northEast != null && shore == null
        val isPolygon = southWest == null && northEast == null && shore != null
        require(isRectangle || isPolygon) { "an area needs south_west and north_east, or a shore" }
        if (southWest != null && northEast != null) {
            require(southWest.x < northEast.x && southWest.y < northEast.y) {
                "north_east (${northEast.x}, ${northEast.y}) must lie north and east of " +
                    "south_west (${southWest.x}, ${southWest.y})"
            }
        }
        water()
    }

    /** Corners of the shore in order, m. */
    public fun corners(): List<Position> = if (southWest != null && northEast != null) {
        listOf(
            southWest.position,
            Position(northEast.x, southWest.y),
            northEast.position,
            Position(southWest.x, northEast.y),
        )
    } else {
        shore.orEmpty().map { it.position }
    }

    /** The water. */
    public fun water(): WaterArea = WaterArea(corners(), keepOuts.map { ring -> ring.map { it.position } })
}

/** The cells of the map: [columns] by [rows] of [cell] m, from the [southWest] corner, not turned. */
@Serializable
public data class GridSpec(
    @SerialName("south_west") val southWest: PlaceSpec,
    val columns: Int,
    val rows: Int,
    @SerialName("cell_m") val cell: Double,
) {
    init {
        grid()
    }

    /** The cells. */
    public fun grid(): Grid = Grid(southWest.position, columns, rows, cell)
}

/**
 * What a probe on a board's port measures.
 *
 * @property unit as it is written behind a value; empty where it has none.
 */
@Serializable
public enum class Quantity(public val unit: String) {
    /** Dissolved oxygen, mg/L. */
    @SerialName("dissolved-oxygen")
    DISSOLVED_OXYGEN("mg/L"),

    /** Acidity, dimensionless. */
    @SerialName("acidity")
    ACIDITY(""),

    /** Electrical conductivity, µS/cm. */
    @SerialName("conductivity")
    CONDUCTIVITY("µS/cm"),

    /** Water temperature, °C. */
    @SerialName("temperature")
    TEMPERATURE("°C"),

    /** Depth of the water below the transducer, m. */
    @SerialName("depth")
    DEPTH("m"),
}

/**
 * The probe whose readings make the map.
 *
 * @property quantity what it measures.
 * @property port of the board; null where only one probe measures it.
 * @property lowest least value the water can have, sensor units; the map's prior and the range of what is taken.
 * @property highest greatest value.
 * @property largestJump from one reading to the next that needs no confirmation, sensor units; null for a fifth of the
 *   range.
 * @property stuckAfter equal readings in a row that a sound probe does not give, at least 2: where it is noisy beside
 *   its resolution, so that one that says the same again and again is stuck; null where equal readings are nothing
 *   special.
 * @property latency from sample to arrival of its line, s, at least 0.
 * @property longestTimeConstant slowest response that is possible, s, for the interval filter; median of what the
 *   self-calibrating and the Bayesian estimator believe beforehand.
 * @property smallestSlope that counts as one for the bounded filter, sensor units/s, at least 0; null for
 *   [DEFAULT_SLOPE] of the range.
 * @property readingError most that a reading may be off for noise and resolution, for the interval filter, sensor
 *   units, at least 0; null for [DEFAULT_ERROR] of the range.
 */
@Serializable
public data class ProbeSpec(
    val quantity: Quantity,
    val port: Int? = null,
    val lowest: Double,
    val highest: Double,
    @SerialName("largest_jump") val largestJump: Double? = null,
    @SerialName("stuck_after") val stuckAfter: Int? = null,
    @SerialName("latency_s") val latency: Double = 0.0,
    @SerialName("longest_time_constant_s") val longestTimeConstant: Double = 20.0,
    @SerialName("smallest_slope_per_s") val smallestSlope: Double? = null,
    @SerialName("reading_error") val readingError: Double? = null,
) {
    init {
        require(port == null || port in 0..9) { "port ($port) must be in 0..9" }
        require(lowest < highest && lowest.isFinite() && highest.isFinite()) {
            "lowest ($lowest) must be below highest ($highest), both finite"
        }
        require(largestJump == null || (largestJump > 0 && largestJump.isFinite())) {
            "largest_jump ($largestJump) must be above 0 and finite"
        }
        require(stuckAfter == null || stuckAfter >= 2) { "stuck_after ($stuckAfter readings) must be at least 2" }
        require(latency in 0.0..LONGEST_LATENCY) { "latency_s ($latency s) must be in [0, $LONGEST_LATENCY]" }
        require(longestTimeConstant > 0 && longestTimeConstant.isFinite()) {
            "longest_time_constant_s ($longestTimeConstant s) must be above 0 and finite"
        }
        require(smallestSlope == null || (smallestSlope >= 0 && smallestSlope.isFinite())) {
            "smallest_slope_per_s ($smallestSlope per s) must be at least 0 and finite"
        }
        require(readingError == null || (readingError >= 0 && readingError.isFinite())) {
            "reading_error ($readingError) must be at least 0 and finite"
        }
    }

    /** What the water can have, sensor units. */
    public val range: Interval get() = Interval(lowest, highest)

    public companion object {
        /** Share of the range, per s: noise of a five-hundredth of it, read every second, seldom has a steeper slope. */
        public const val DEFAULT_SLOPE: Double = 0.002

        /** Share of the range: four standard deviations of that noise, and some resolution. */
        public const val DEFAULT_ERROR: Double = 0.01

        /** The pose history reaches a minute back. */
        private const val LONGEST_LATENCY = 30.0

        /**
         * Reads the JSON form.
         *
         * @throws IllegalArgumentException as [MissionSpec.fromJson] does.
         */
        public fun fromJson(json: String): ProbeSpec = FORM.read(json)

        private val FORM = JsonForm(serializer(), "a probe")
    }
}

/**
 * The boat: its speeds and its thrusters.
 *
 * @property topSpeed at full thrust, m/s.
 * @property cruise on the way, m/s.
 * @property arrival a waypoint is reached within this distance, m.
 * @property mixing what thrusters it has: a boat with one that swivels does not understand what is said to two.
 */
@Serializable
public data class BoatSpec(
    @SerialName("top_speed_m_s") val topSpeed: Double = 1.6,
    @SerialName("cruise_m_s") val cruise: Double = 1.0,
    @SerialName("arrival_m") val arrival: Double = 1.5,
    val mixing: Mixing = Mixing.DIFFERENTIAL,
) {
    init {
        follower()
    }

    internal fun follower() = FollowerSettings(topSpeed = topSpeed, cruise = cruise, arrival = arrival)
}

/** What to do in a danger, as JSON has it. */
@Serializable
public enum class FailsafeSpec(internal val failsafe: Failsafe) {
    /** Stay, under power. */
    @SerialName("hold")
    HOLD(Failsafe.HOLD),

    /** Go home. */
    @SerialName("return-home")
    RETURN_HOME(Failsafe.RETURN_HOME),

    /** Rest the motors. */
    @SerialName("stop")
    STOP(Failsafe.STOP),
}

/**
 * What to do where the mission can't go on. A lost link or place always rests the motors.
 *
 * @property battery when the boat's battery is low, or the phone's.
 * @property lowestVolts below which the boat's is, V; 0 where none is measured; null where the mission does not say,
 *   which watches none either.
 * @property lowestPhonePercent below which the phone's is, percent; 0 where it is not to be watched. The default is
 *   where Android itself begins to warn (`config_lowBatteryWarningLevel`).
 * @property fence when the boat is beyond the shore line.
 * @property end when the mission has nothing left to do, or can no longer be written down.
 * @property rearms whether a board that disarmed itself, as after a long cut, is armed again without a person.
 */
@Serializable
public data class FailsafePolicy(
    val battery: FailsafeSpec = FailsafeSpec.RETURN_HOME,
    @SerialName("lowest_volts") val lowestVolts: Double? = null,
    @SerialName("lowest_phone_percent") val lowestPhonePercent: Double = 15.0,
    val fence: FailsafeSpec = FailsafeSpec.RETURN_HOME,
    val end: FailsafeSpec = FailsafeSpec.RETURN_HOME,
    val rearms: Boolean = true,
) {
    init {
        settings()
    }

    internal fun settings() = SafetySettings(
        lowestVolts = lowestVolts ?: 0.0,
        lowestPhonePercent = lowestPhonePercent,
        answers = mapOf(
            Danger.BATTERY_LOW to battery.failsafe,
            Danger.PHONE_LOW to battery.failsafe,
            Danger.FENCE to fence.failsafe,
            Danger.BUDGET_SPENT to Failsafe.RETURN_HOME,
            Danger.MISSION_END to end.failsafe,
            Danger.LOG_LOST to end.failsafe,
            Danger.OPERATOR_HOLD to Failsafe.HOLD,
            Danger.OPERATOR_RETURN to Failsafe.RETURN_HOME,
        ),
    )
}

/**
 * A mission as data.
 *
 * @property name what tables call it.
 * @property origin where the frame has its zero.
 * @property area the water; its shore and its keep-outs are the safety gate's fence.
 * @property grid the map's cells.
 * @property probe what is measured.
 * @property estimator by its name.
 * @property planner by its name.
 * @property budget what may be used.
 * @property home where the mission ends; in the water.
 * @property boat its speeds and thrusters.
 * @property failsafe policy.
 * @property seed of planners that draw.
 * @throws IllegalArgumentException if the parts do not fit together: home off the water, a grid off the water, or a
 *   planner that goes from cell to cell where land lies between two cells, or home where no way leads away from it.
 */
@Serializable
public data class MissionSpec(
    val name: String,
    val origin: OriginSpec,
    val area: AreaSpec,
    val grid: GridSpec,
    val probe: ProbeSpec,
    val estimator: EstimatorName = EstimatorName.BOUNDED_EXTENDED,
    val planner: PlannerName = PlannerName.BOUNDED_EXTENDED,
    val budget: BudgetSpec,
    val home: PlaceSpec,
    val boat: BoatSpec = BoatSpec(),
    val failsafe: FailsafePolicy = FailsafePolicy(),
    val seed: Long = 1,
) {
    init {
        val water = area.water()
        require(home.position in water) { "home (${home.x}, ${home.y}) must lie on the water" }
        requireWay(water)
        val cells = grid.grid()
        if (!planner.keepsToWater) {
            for (cell in 0 until cells.size) requireWater(water, cells, cell)
        } else {
            require((0 until cells.size).any { cells.center(it) in water }) { "no cell of the grid lies on the water" }
        }
    }

    /** The JSON form, on one line. */
    public fun toJson(): String = Json.encodeToString(serializer(), this)

    private fun requireWay(water: WaterArea) {
        if (area.isOpen) return
        val resolution = WaterRoutes.resolution(water, grid.cell / 2)
        require(WaterRoutes.leadsFrom(water, boat.wayMargin, resolution, home.x, home.y)) {
            "home (${home.x}, ${home.y}) must have water about it that is farther than ${boat.wayMargin} m from land " +
                "and keep-outs; move it away from them"
        }
    }

    private fun requireWater(water: WaterArea, cells: Grid, cell: Int) {
        val x = cells.centerX(cell)
        val y = cells.centerY(cell)
        val right = if ((cell + 1) % cells.columns == 0) cell else cell + 1
        val up = if (cell + cells.columns >= cells.size) cell else cell + cells.columns
        val isFree = water.isClear(x, y, cells.centerX(right), cells.centerY(right), 0.0) &&
            water.isClear(x, y, cells.centerX(up), cells.centerY(up), 0.0)
        require(isFree) {
            "this planner goes from cell to cell, but the cell at ($x, $y) or the way from it to the next is not all " +
                "within the area or touches a keep-out; take a grid within the area, or polygon-rrt"
        }
    }

    public companion object {
        /**
         * Reads the JSON form.
         *
         * @throws stillwater.model.JsonProblem if [json] is not of that form or a number is out of its range; the
         *   message is one line that says where and what was expected.
         */
        public fun fromJson(json: String): MissionSpec = FORM.read(json)

        private val FORM = JsonForm(serializer(), "a mission")
    }
}
