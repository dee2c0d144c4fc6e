package stillwater.simulation

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Test
import stillwater.virtual.BoardSpec
import stillwater.world.Flow
import stillwater.world.WorldSettings
import kotlin.math.hypot
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What is said of a simulated mission. Seeds fixed before the first run. */
class SimulationSummaryTest {
    private val drifting = WorldSettings(seed = 531, current = Flow(0.3, 0.0), board = BoardSpec(oxygenPeriod = 1.0))

    private fun sail(settings: WorldSettings, longest: Double) =
        SmallMission.sail(SmallMission.pond("averaging"), settings, longest)

    private fun SimulationResult.fact(name: String) = SimulationSummary(this, "mg/L").facts.toMap().getValue(name)

    private fun SimulationResult.json(): JsonObject =
        Json.parseToJsonElement(SimulationJson.text(this, emptyList())).jsonObject

    @Test
    fun aMissionThatIsNotOverIsToldByTheTimeItHad() {
        val result = sail(drifting, longest = 60.0)
        val since = SimulationSummary.clock(result.run.history.spans.last().from)
        assertEquals("pond: not over after 1:00 min: surveying since $since", result.fact("mission"))
        assertTrue(since != "1:00 min")
        assertEquals("not over, surveying", SimulationSummary(result, "mg/L").headline.toMap()["End"])
    }

    @Test
    fun aMissionThatIsOverIsToldByWhenItEnded() {
        val result = sail(drifting, longest = 1000.0)
        val end = SimulationSummary.clock(result.run.history.spans.last().from)
        assertEquals("pond: stopped (completed) after $end", result.fact("mission"))
    }

    /** A boat drifts before its mission begins and after it is over; that is no part of its way. */
    @Test
    fun theWayIsThatOfTheTimeUnderWay() {
        val result = sail(drifting, longest = 1000.0)
        val track = result.run.track
        val spans = result.run.history.spans.filter { it.state.isUnderWay }
        val way = (1 until track.size)
            .filter { step -> spans.any { track.time(step - 1) >= it.from && track.time(step - 1) < it.until } }
            .sumOf { hypot(track.x(it) - track.x(it - 1), track.y(it) - track.y(it - 1)) }
        // Rounding of a few thousand sums.
        assertEquals(way, track.distanceUnderWay, 1e-6)
        assertTrue(track.distance > way + 1, "${track.distance} m with the drift, $way m without")
        assertContains(result.fact("way"), Regex("^${Math.round(way)} m in "))
        val json = result.json().getValue("way").jsonObject
        assertEquals(track.distance, json.getValue("distance_m").jsonPrimitive.double)
        assertEquals(track.distanceUnderWay, json.getValue("distance_under_way_m").jsonPrimitive.double)
    }

    @Test
    fun aBoatThatDidNotSetOutHasNoWay() {
        val result = sail(drifting, longest = 10.0)
        assertTrue(result.run.track.distance > 1, "${result.run.track.distance} m of drift")
        assertEquals("0 m in 0:00 min", result.fact("way").substringBefore(";"))
    }

    @Test
    fun overNoCellThereIsNoError() {
        // Before the board is awake.
        val result = sail(drifting, longest = 1.0)
        val errors = result.json().getValue("map").jsonObject.getValue("error_at_centres").jsonObject
        for (name in listOf("mean_abs", "rms", "largest")) assertEquals(JsonNull, errors[name], name)
    }

    @Test
    fun cellsThatWereGivenUpAreNamed() {
        // As fast as the boat cruises: it comes no nearer to what lies upstream.
        val result = sail(drifting.copy(current = Flow(1.0, 0.0)), longest = 600.0)
        val count = result.run.mission.run { givenUpCells.size + givenUpOffMap.size }
        assertTrue(count > 0, "no cell was given up")
        val warnings = SimulationSummary(result, "mg/L").warnings
        assertContains(
            warnings.joinToString("\n"),
            Regex("$count cells? given up, because the boat came no nearer: \\("),
        )
    }
}
