package stillwater.app.screen

import stillwater.app.link.BoardReport
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState
import stillwater.app.mission.LogReport
import stillwater.app.mission.MissionReport
import stillwater.app.mission.PastMission
import stillwater.app.mission.ReadingCounts
import stillwater.app.mission.TracePoint
import stillwater.app.pose.PhoneFix
import stillwater.app.service.BoatActivity
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.FixCounts
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.app.service.PreflightReason
import stillwater.estimate.BoundedExtendedFilter
import stillwater.estimate.update
import stillwater.field.FieldMap
import stillwater.mission.AreaSpec
import stillwater.mission.BudgetSpec
import stillwater.mission.FailsafePolicy
import stillwater.mission.GivenUp
import stillwater.mission.GridSpec
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.mission.OriginSpec
import stillwater.mission.PlaceSpec
import stillwater.mission.PlannerName
import stillwater.mission.ProbeSpec
import stillwater.mission.Quantity
import stillwater.mission.Wish
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LatLon
import stillwater.model.Position
import stillwater.sensor.FirstOrderLag
import stillwater.wire.BoardState
import kotlin.math.exp
import kotlin.math.hypot

/** What the screens' tests and pictures show: a pond of 100 m by 60 m, half surveyed by a boat with a slow probe. */
internal object Scenes {
    private val shore =
        listOf(0 to -4, 60 to -9, 108 to 0, 112 to 40, 84 to 66, 30 to 69, -8 to 50, -10 to 12)
            .map { (x, y) -> place(x, y) }
    private val island = listOf(60 to 51, 71 to 50, 74 to 58, 64 to 60).map { (x, y) -> place(x, y) }

    val spec =
        MissionSpec(
            name = "North pond",
            origin = OriginSpec(45.33, -73.15),
            area = AreaSpec(shore = shore, keepOuts = listOf(island)),
            grid = GridSpec(place(0, 0), columns = 20, rows = 12, cell = 5.0),
            probe = ProbeSpec(Quantity.DISSOLVED_OXYGEN, lowest = 4.0, highest = 12.0),
            planner = PlannerName.POLYGON_RRT,
            budget = BudgetSpec(metres = 1500.0),
            home = place(2, 3),
            failsafe = FailsafePolicy(lowestVolts = 13.2),
        )
    private val grid = spec.grid.grid()

    /** The last lane, shortened by the shore. */
    private val aroundTheIsland =
        listOf(87.5 to 57.5, 80.0 to 62.5, 56.0 to 62.5, 50.0 to 57.5, 12.5 to 57.5).map { (x, y) -> Position(x, y) }

    /** Between two lanes, and east of the map. */
    private val weeds = GivenUp(listOf(177, 178), listOf(Position(102.5, 42.5)))
    private val trace = ArrayList<TracePoint>()
    private val track = ArrayList<Position>()
    private val map: FieldMap = surveyed()

    /** The mission under way. */
    val report = report(MissionState.Surveying)

    /** All in order, the link connected. */
    val standingBy =
        BoatSnapshot(
            activity = BoatActivity.STANDING_BY,
            linkName = "Boat 3",
            link =
            LinkHealth(
                LinkState.CONNECTED,
                connects = 2,
                drops = 1,
                failures = 3,
                bytesIn = 48_213,
                bytesOut = 10_480,
                writesDropped = 4,
                quietMillis = 87,
                lastError = "read failed, socket might closed",
            ),
            board = BoardReport(5_210, 3, 0, BoardState.STANDBY, 15.26, oxygen = 8.71, celsius = 19.4),
            fix = PhoneFix(LatLon(45.3303, -73.1495), 3.2f, 0.9f, 12f, 0),
            fixAgeSeconds = 0.4,
            fixes = FixCounts(812, 2, 1, 0),
            headingDeg = 12f,
            phoneBatteryPercent = 71,
            preflight = PreflightCheck.entries.map { PreflightItem(it, ready = true) },
            past = emptyList(),
        )

    /** The mission of [spec], loaded and not begun. */
    val loaded = standingBy.copy(mission = report(MissionState.Idle))

    /** On the way. */
    val surveying = standingBy.copy(mission = report, board = standingBy.board.copy(state = BoardState.ACTIVE))

    /** As it looks after the process ended: link lost, checklist red. */
    val recovered =
        loaded.copy(
            activity = BoatActivity.RECOVERED,
            mission = report(MissionState.Idle, isRecovered = true),
            board = BoardReport(),
            link = standingBy.link.copy(state = LinkState.WAITING, drops = 2, quietMillis = null),
            fixAgeSeconds = 41.0,
            preflight =
            PreflightCheck.entries.map { check ->
                val reason =
                    when (check) {
                        PreflightCheck.LINK -> PreflightReason.NOT_CONNECTED
                        PreflightCheck.FIX -> PreflightReason.FIX_OLD
                        PreflightCheck.BATTERY_SAVER -> PreflightReason.NOT_EXEMPT
                        else -> null
                    }
                PreflightItem(check, reason == null, reason)
            },
        )

    /** Missions that were. */
    val past =
        listOf(
            PastMission("2026-07-14T07-02-31-North-pond.log", 4_312_004, true, 1_784_021_460_000),
            PastMission("2026-07-13T15-02-05-Mill-bay.log.incomplete", 912_331, false, 1_783_954_920_000),
            PastMission("2026-07-12T08-15-40-Mill-bay.log", 2_120_560, true, 1_783_844_100_000),
        )

    fun report(
        state: MissionState,
        wish: Wish = Wish.GO_ON,
        isRecovered: Boolean = false,
        isOver: Boolean = false,
        position: Position? = track.last(),
        probeSilence: Double? = null,
        restsFor: Double = 0.0,
    ) =
        MissionReport(
            spec = spec,
            state = state,
            wish = wish,
            isRecovered = isRecovered,
            isOver = isOver,
            map = map,
            position = position,
            track = track,
            plan = lane(ROWS_DONE).reversed() + lane(ROWS_DONE + 2) + aroundTheIsland,
            used = if (state == MissionState.Idle && !isRecovered) 0.0 else 662.0,
            trace = trace.takeLast(TRACE),
            counts = ReadingCounts(1_412, 1_400, 0, 2, 3, 0, 7, 3, 41),
            log = LogReport("2026-07-14T09-31-12-North-pond.log.incomplete", 9_113, 9_110),
            probeSilence = probeSilence,
            givenUp = weeds,
            restsFor = restsFor,
            readAt = DoubleArray(grid.size) { if (map.readings(it) > 0) 1.0 * it * SECONDS_A_CELL else Double.NaN },
            now = ROWS_DONE * grid.columns * SECONDS_A_CELL.toDouble(),
        )

    /** The scene of the half surveyed pond. */
    fun halfSurveyed() =
        MapScene(
            map = map,
            track = track,
            fence = spec.area.corners(),
            home = spec.home.position,
            boat = track.last(),
            unit = "mg/L",
            givenUp = weeds,
            ageOf = { if (map.readings(it) > 0) 125.0 else null },
        )

    /** Lanes along the rows, there and back; mg/L of oxygen. */
    private fun surveyed(): FieldMap {
        val filter = BoundedExtendedFilter(grid, spec.probe.range)
        val sensor = FirstOrderLag(TIME_CONSTANT, oxygen(grid.center(0)))
        var time = 0.0
        for (row in 0 until ROWS_DONE) {
            for (step in 0 until grid.columns) {
                val column = if (row % 2 == 0) step else grid.columns - 1 - step
                val cell = row * grid.columns + column
                val center = grid.center(cell)
                track += center
                repeat(SECONDS_A_CELL) {
                    time += 1.0
                    val value = sensor.step(oxygen(center), 1.0, Conditions.NONE)
                    filter.update(BoatTime(time), center.x, center.y, value)
                    val now = filter.map
                    val slope = (value - (trace.lastOrNull()?.reading ?: value))
                    trace += TracePoint(time, value, slope, cell, now.value(cell), now.lower(cell), now.upper(cell))
                }
            }
        }
        return filter.map.copy()
    }

    private fun lane(row: Int) =
        listOf(0, grid.columns - 1).map { grid.center(row * grid.columns + it) }

    private fun place(x: Int, y: Int) = PlaceSpec(x.toDouble(), y.toDouble())

    /** A plume in water that is otherwise even. */
    private fun oxygen(at: Position): Double = 9.0 - 4.0 * exp(-hypot(at.x - 50.0, at.y - 30.0) / 20.0)

    private const val ROWS_DONE = 7
    private const val SECONDS_A_CELL = 10
    private const val TIME_CONSTANT = 8.0

    /** Five minutes of readings. */
    private const val TRACE = 300
}
