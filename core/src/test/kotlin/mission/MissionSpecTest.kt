package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.control.Mixing
import stillwater.model.JsonProblem
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class MissionSpecTest {
    private fun refusal(old: String, new: String): String {
        check(old in Desk.SMALL)
        val text = assertFailsWith<IllegalArgumentException> {
            MissionSpec.fromJson(Desk.SMALL.replace(old, new))
        }.message
        return text.orEmpty()
    }

    /** Half a cell's lattice would have 640 000 points. */
    @Test
    fun aMissionOfFewCellsInMuchWaterIsTakenAndPlanned() {
        val text = Desk.SMALL.replace("-20", "-200").replace("80", "200").replace("\"cell_m\":10", "\"cell_m\":1")
            .replace("lawnmower", "polygon-rrt").replace("self-calibrating", "averaging")
        val islands = "},\"keep_outs\":[[{\"x_m\":50,\"y_m\":50},{\"x_m\":60,\"y_m\":50},{\"x_m\":60,\"y_m\":60}]]},"
        for (json in listOf(text, text.replace("\"y_m\":200}},", "\"y_m\":200$islands"))) {
            val desk = Desk(MissionSpec.fromJson(json), 601)
            desk.mission.start()
            assertTrue(desk.until(60.0) { it == MissionState.Surveying && desk.mission.waypoints().isNotEmpty() })
        }
    }

    @Test
    fun aHomeThatNoWayLeadsFromIsRefused() {
        // A creek 1 m wide, where ways keep 0.75 m from land.
        val creek = listOf(0 to 0, 60 to 0, 60 to 60, 0 to 60, 0 to 31, -60 to 31, -60 to 30, 0 to 30)
            .joinToString(",", "{\"shore\":[", "]}") { (x, y) -> "{\"x_m\":$x,\"y_m\":$y}" }
        val area = Desk.SMALL.substringAfter("\"area\":").substringBefore(",\n            \"grid\"")
        val json = Desk.SMALL.replace(area, creek).replace("\"x_m\":0,\"y_m\":0},\"col", "\"x_m\":1,\"y_m\":1},\"col")
            .replace("\"cell_m\":10", "\"cell_m\":9")
        MissionSpec.fromJson(json)
        val home = "\"home\":{\"x_m\":5,\"y_m\":5}"
        val refused = assertFailsWith<JsonProblem> {
            MissionSpec.fromJson(json.replace(home, "\"home\":{\"x_m\":-40,\"y_m\":30.5}"))
        }
        assertTrue("farther than 0.75 m from land" in refused.message.orEmpty(), refused.message)
    }

    @Test
    fun theJsonFormIsReadBack() {
        val spec = Desk.small()
        assertEquals(spec, MissionSpec.fromJson(spec.toJson()))
        assertEquals(1, spec.toJson().lines().size)
    }

    @Test
    fun missionsOfBeforeThrustersWereNamedHaveTwo() {
        assertEquals(Mixing.DIFFERENTIAL, Desk.small().boat.mixing)
        assertTrue("mixing" !in Desk.small().toJson())
        val boat = "\"boat\":{\"mixing\":\"vectored\"},"
        val vectored = MissionSpec.fromJson(Desk.SMALL.replace("\"home\"", "$boat\"home\""))
        assertEquals(Mixing.VECTORED, vectored.boat.mixing)
        assertEquals(vectored, MissionSpec.fromJson(vectored.toJson()))
    }

    @Test
    fun whatIsWrongIsSaidInOneLineThatNamesItsPlace() {
        for ((old, new, expected) in listOf(
            Triple("\"columns\":6", "\"columns\":0", listOf("columns (0)", ": grid: ")),
            Triple("\"columns\":6", "\"columns\":\"six\"", listOf(": grid.columns: ")),
            Triple("\"columns\":6,", "", listOf("columns", ": grid: ")),
            Triple(
                "\"home\":{",
                "\"boat\":{\"mixing\":\"jet\"},\"home\":{",
                listOf("differential", "vectored", "jet", ": boat.mixing: "),
            ),
            Triple("lawnmower", "mower", listOf("mower", ": planner: ")),
            Triple("self-calibrating", "best", listOf("best", ": estimator: ")),
            Triple("\"lowest\":0", "\"lowest\":20", listOf("lowest (20.0)", ": probe: ")),
            Triple("\"lowest\":0", "\"lowest\":0,\"reading_error\":-1", listOf("reading_error (-1.0)", ": probe: ")),
            Triple(
                "\"lowest\":0",
                "\"lowest\":0,\"smallest_slope_per_s\":-1",
                listOf("smallest_slope_per_s (-1.0", ": probe: "),
            ),
            Triple("{\"seconds\":900}", "{}", listOf("either metres or seconds", ": budget: ")),
            Triple("\"x_m\":80", "\"x_m\":-80", listOf("north_east", ": area: ")),
            Triple("\"home\":{\"x_m\":5", "\"home\":{\"x_m\":500", listOf("home (500.0, 5.0)", "water")),
            Triple("\"cell_m\":10", "\"cell_m\":30", listOf("from cell to cell", "polygon-rrt")),
            Triple("\"budget\"", "\"bugdet\"", listOf("bugdet")),
            Triple(
                "\"home\":{",
                "\"home\":{\"x_m\":70,\"y_m\":70},\"home\":{",
                listOf("each field once", "'home' again"),
            ),
        )) {
            val text = refusal(old, new)
            assertEquals(1, text.lines().size, text)
            assertTrue(expected.all { it in text }, "$new: $text")
        }
    }
}
