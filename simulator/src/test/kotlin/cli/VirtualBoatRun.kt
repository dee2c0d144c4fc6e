package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.RecoveredMission
import stillwater.virtual.BoardSpec
import stillwater.virtual.LinkSpec
import stillwater.world.VirtualWorld
import stillwater.world.WorldSettings
import stillwater.world.WorldSite

/** Runs `stillwater` with [arguments] as typed by a user, of the commands that have to do with a boat. */
internal fun runBoatCommand(vararg arguments: String): CliktCommandTestResult =
    Stillwater().subcommands(VirtualBoatCommand(), DriveCommand(), ReplayCommand()).test(arguments.toList())

/** A mission over four by four cells. */
internal const val POND = """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
    "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":60,"y_m":60}},
    "grid":{"south_west":{"x_m":0,"y_m":0},"columns":4,"rows":4,"cell_m":10},
    "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
    "estimator":"self-calibrating","planner":"bounded-extended","budget":{"seconds":300},"home":{"x_m":5,"y_m":5}}"""

/** The log and the mission of [seconds] s with a virtual boat whose link loses and changes bytes. */
internal fun sailed(
    seed: Long,
    seconds: Int,
    recovered: RecoveredMission? = null,
    spec: MissionSpec = MissionSpec.fromJson(POND),
    orders: (Int, Mission) -> Unit = { _, _ -> },
): Pair<List<String>, Mission> {
    val settings = WorldSettings(
        seed = seed,
        board = BoardSpec(oxygenPeriod = 1.0),
        link = LinkSpec(loss = 1e-3, corruption = 1e-3),
    )
    val world = VirtualWorld(settings, WorldSite.of(spec))
    val lines = ArrayList<String>()
    val log = MissionLog(lines::add, LogStart(1_700_000_000_000, "2023"), spec)
    val mission = Mission(spec, world.boat.phone, log, recovered = recovered)
    repeat(seconds * 10) { step ->
        world.advance(0.1)
        world.boat.takeFix()?.let { mission.fix(it.time, it.place) }
        mission.compass(world.time, world.boat.heading(), world.boat.yawRate)
        if (step == 30) mission.start()
        orders(step, mission)
        mission.step(world.time)
    }
    return lines to mission
}
