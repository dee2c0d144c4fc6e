package stillwater.world

import stillwater.control.Mixing
import stillwater.mission.MissionSpec
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.LatLon
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.virtual.BoardSpec
import stillwater.virtual.Hull
import stillwater.virtual.LinkSpec
import stillwater.virtual.PoseSpec

/**
 * What a mission says of the virtual world that it takes place in.
 *
 * @property origin zero of the frame that everything has its metres in.
 * @property grid cells over which the water is drawn.
 * @property range what the probe can show, sensor units.
 * @property start where the boat lies at first.
 * @property isVectored whether the boat has a swivelled thruster in place of two fixed ones.
 */
data class WorldSite(
    val origin: LatLon,
    val grid: Grid,
    val range: Interval,
    val start: Position,
    val isVectored: Boolean = false,
) {
    companion object {
        /** Where [mission] takes place; the boat lies at its home. */
        fun of(mission: MissionSpec): WorldSite = WorldSite(
            LatLon(mission.origin.latitude, mission.origin.longitude),
            mission.grid.grid(),
            mission.probe.range,
            Position(mission.home.x, mission.home.y),
            isVectored = mission.boat.mixing == Mixing.VECTORED,
        )
    }
}

/**
 * Velocity of air or water.
 *
 * @property east m/s, towards the east. @property north m/s, towards the north.
 */
data class Flow(val east: Double, val north: Double) {
    init {
        require(east.isFinite() && north.isFinite()) { "east, north ($east, $north m/s) must be finite" }
    }

    companion object {
        /** Stillness. */
        val NONE = Flow(0.0, 0.0)
    }
}

/**
 * All that a virtual world is made of; the same settings and site give the same world, byte for byte.
 *
 * @property seed where all chance comes from: noise, fixes, link and, unless [waterSeed] is given, the water.
 * @property water which water.
 * @property waterRange of the water at the cells' centres, sensor units; null for the middle eight tenths of what the probe
 *   can show, so that noise does not carry a reading out of it.
 * @property waterSeed where the water comes from; null for [seed].
 * @property sensor the probe; null for a first-order lag of 10 s with noise of 0.002 of the probe's range.
 * @property wind velocity of the air, constant.
 * @property current velocity of the water at first.
 * @property currentTurn time in which the current turns once round counter-clockwise, s, above 0; infinite for never.
 * @property pose fixes and compass.
 * @property link between phone and board.
 * @property board electronics; its voltage is that of a full battery.
 * @property battery what the motors draw on.
 * @property hull boat and thrusters.
 * @throws IllegalArgumentException if a number is out of its range.
 */
data class WorldSettings(
    val seed: Long = 1,
    val water: WaterKind = WaterKind.GAUSSIAN,
    val waterRange: Interval? = null,
    val waterSeed: Long? = null,
    val sensor: SensorSpec? = null,
    val wind: Flow = Flow.NONE,
    val current: Flow = Flow.NONE,
    val currentTurn: Double = Double.POSITIVE_INFINITY,
    val pose: PoseSpec = PoseSpec(),
    val link: LinkSpec = LinkSpec(),
    val board: BoardSpec = BoardSpec(),
    val battery: BatterySpec = BatterySpec(),
    val hull: Hull = Hull(),
) {
    init {
        require(currentTurn > 0) { "currentTurn ($currentTurn s) must be above 0" }
    }

    /** The water's range at [site], sensor units. */
    fun waterRangeAt(site: WorldSite): Interval = waterRange ?: site.range.run {
        Interval(lower + EDGE * width, upper - EDGE * width)
    }

    /** The probe at [site]. */
    fun sensorAt(site: WorldSite): SensorSpec = sensor ?: SensorSpec(
        "first-order-lag",
        listOf(SensorStage.Lag(LAG), SensorStage.Noise(NOISE * site.range.width)),
    )

    private companion object {
        /** Time constant of the probe where none is given, s: a galvanic oxygen probe's, 5 to 25 s. */
        const val LAG = 10.0

        /** Share of the range. */
        const val NOISE = 0.002
        const val EDGE = 0.1
    }
}
