package stillwater.simulation

import stillwater.mission.MissionSpec
import stillwater.world.WorldSettings

/** Missions that are soon over, for tests. */
internal object SmallMission {
    /** Six by six cells of 10 m, five minutes on the lawnmower's way. */
    fun pond(estimator: String, more: String = ""): MissionSpec = MissionSpec.fromJson(pondJson(estimator, more))

    fun pondJson(estimator: String, more: String = ""): String = """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
        "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":80,"y_m":80}},
        "grid":{"south_west":{"x_m":0,"y_m":0},"columns":6,"rows":6,"cell_m":10},
        "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},$more
        "estimator":"$estimator","planner":"lawnmower","budget":{"seconds":300},"home":{"x_m":5,"y_m":5}}"""

    /** Ten by ten cells of 10 m, half an hour. */
    fun tenByTen(estimator: String, planner: String = "bounded-extended"): MissionSpec = MissionSpec.fromJson(
        """{"name":"ten by ten","origin":{"lat_deg":45.5,"lon_deg":-73.6},
        "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":120,"y_m":120}},
        "grid":{"south_west":{"x_m":0,"y_m":0},"columns":10,"rows":10,"cell_m":10},
        "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
        "estimator":"$estimator","planner":"$planner","budget":{"seconds":1800},"home":{"x_m":5,"y_m":5}}""",
    )

    /** The whole of [spec]. */
    fun sail(
        spec: MissionSpec,
        settings: WorldSettings,
        longest: Double = MissionRun.longest(spec),
    ): SimulationResult {
        val run = MissionRun(spec, settings) {}
        val film = Film(run, MissionRun.expected(spec))
        while (!run.isOver && run.time.seconds < longest) {
            run.step()
            film.watch()
        }
        film.end()
        return SimulationResult(run, film, longest)
    }
}
