package stillwater.mission

import kotlinx.serialization.json.Json
import org.junit.jupiter.api.Test
import stillwater.model.LatLon
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

class MissionDraftTest {
    private val triangle = MissionDraft(name = "Pond")
        .around(LatLon(45.33, -73.15))
        .copy(shore = listOf(place(0, 0), place(60, 0), place(0, 40)), home = place(5, 5))
        .with(DraftField.LOWEST_VOLTS, "13.2")

    @Test
    fun whatWasDrawnBecomesAMissionThatCoversIt() {
        val spec = assertNotNull(triangle.check().spec, "${triangle.check().problems}")
        assertEquals(MissionSpec.fromJson(spec.toJson()), spec)
        assertEquals(12 to 8, spec.grid.columns to spec.grid.rows)
        assertEquals(PlannerName.POLYGON_RRT, spec.planner)
        assertEquals(1000.0, spec.budget.metres)
    }

    @Test
    fun aRectangleIsFilledWithCellsThatAnyPlannerMayUse() {
        val corners = triangle.copy(isRectangle = true, shore = listOf(place(0, 40), place(63, 0)))
        val spec = assertNotNull(corners.copy(planner = PlannerName.LAWNMOWER).check().spec)
        // 63 m hold twelve cells of 5 m, with a margin on both sides.
        assertEquals(GridSpec(PlaceSpec(1.5, 0.0), 12, 8, 5.0), spec.grid)
    }

    @Test
    fun eachProblemIsSaidAtItsField() {
        val crossing = listOf(place(0, 0), place(60, 40), place(60, 0), place(0, 30))
        for ((draft, field, words) in listOf(
            Triple(triangle.copy(name = " "), DraftField.NAME, "needs a name"),
            Triple(triangle.copy(shore = emptyList()), DraftField.AREA, "no corner"),
            Triple(triangle.copy(shore = crossing), DraftField.AREA, "crosses or touches itself: edge 1"),
            Triple(triangle.copy(shore = crossing.take(2)), DraftField.AREA, "2 different corners; it needs 3"),
            Triple(triangle.copy(isRectangle = true), DraftField.AREA, "two opposite corners, got 3"),
            Triple(triangle.copy(keepOuts = listOf(crossing.take(1))), DraftField.AREA, "keep-out 1 has 1"),
            Triple(triangle.copy(home = null), DraftField.HOME, "not set"),
            Triple(triangle.copy(home = place(60, 40)), DraftField.HOME, "must lie on the water"),
            Triple(triangle.copy(planner = PlannerName.LAWNMOWER), DraftField.PLANNER, "from cell to cell"),
            Triple(triangle.with(DraftField.CELL, "0"), DraftField.CELL, "larger than 0"),
            Triple(triangle.with(DraftField.CELL, "1e-9"), DraftField.CELL, "too many"),
            Triple(triangle.with(DraftField.CELL, ""), DraftField.CELL, "a number is needed"),
            Triple(triangle.with(DraftField.BUDGET, "far"), DraftField.BUDGET, "'far' is not a number"),
            Triple(triangle.with(DraftField.BUDGET, "NaN"), DraftField.BUDGET, "not a number"),
            Triple(triangle.with(DraftField.BUDGET, "1e999"), DraftField.BUDGET, "not a number"),
            Triple(triangle.with(DraftField.BUDGET, "-1"), DraftField.BUDGET, "must be above 0"),
            Triple(triangle.with(DraftField.RESERVE, "-1"), DraftField.RESERVE, "reserve (-1.0)"),
            Triple(triangle.with(DraftField.LOWEST, "20"), DraftField.LOWEST, "must be below highest"),
            Triple(triangle.with(DraftField.LARGEST_JUMP, "0"), DraftField.LARGEST_JUMP, "above 0"),
            Triple(triangle.with(DraftField.PORT, "1.5"), DraftField.PORT, "whole number"),
            Triple(triangle.with(DraftField.PORT, "12"), DraftField.PORT, "0..9"),
            Triple(triangle.with(DraftField.STUCK_AFTER, "1"), DraftField.STUCK_AFTER, "at least 2"),
            Triple(triangle.with(DraftField.STUCK_AFTER, "2.5"), DraftField.STUCK_AFTER, "whole number"),
            Triple(triangle.with(DraftField.SMALLEST_SLOPE, "-1"), DraftField.SMALLEST_SLOPE, "at least 0"),
            Triple(triangle.with(DraftField.READING_ERROR, "-1"), DraftField.READING_ERROR, "at least 0"),
            Triple(triangle.with(DraftField.LATENCY, "99"), DraftField.LATENCY, "latency_s"),
            Triple(triangle.with(DraftField.SLOWEST, "0"), DraftField.SLOWEST, "above 0"),
            Triple(triangle.with(DraftField.CRUISE, "3"), DraftField.CRUISE, "not be above topSpeed"),
            Triple(triangle.with(DraftField.ARRIVAL, "0"), DraftField.ARRIVAL, "above 0"),
            Triple(triangle.with(DraftField.LOWEST_VOLTS, "-1"), DraftField.LOWEST_VOLTS, "at least 0"),
            Triple(triangle.with(DraftField.LOWEST_VOLTS, ""), DraftField.LOWEST_VOLTS, "0 where the board does not"),
        )) {
            val check = draft.check()
            assertNull(check.spec, words)
            assertTrue(words in check.problems[field].orEmpty(), "$field, $words: ${check.problems}")
            assertEquals(1, check.problems.size, "${check.problems}")
        }
    }

    @Test
    fun aMissionComesBackFromItsDraftAsItWas() {
        // A grid that no draft would lay, a seed and a cell size that are nobody's default.
        val failsafe = FailsafePolicy(lowestVolts = 0.0, lowestPhonePercent = 30.0)
        val spec = Desk.small().copy(seed = 7, grid = GridSpec(PlaceSpec(10.0, 10.0), 3, 2, 10.0), failsafe = failsafe)
        val draft = MissionDraft.of(spec)
        assertEquals(spec, draft.check().spec)
        assertEquals(spec, MissionDraft.fromJson(draft.toJson()).check().spec)
        assertEquals(spec.copy(name = "Other"), draft.with(DraftField.NAME, "Other").check().spec)
        val resized = assertNotNull(draft.with(DraftField.CELL, "9").check().spec)
        assertEquals(9.0, resized.grid.cell)
        assertEquals(7L, resized.seed)
    }

    @Test
    fun aHalfTypedDraftIsKeptAsItIs() {
        val half = triangle.with(DraftField.BUDGET, "1e").with(DraftField.CELL, "2,5").copy(keepOuts = listOf(listOf()))
        assertEquals(half, MissionDraft.fromJson(half.toJson()))
        assertEquals(2.5, triangle.with(DraftField.CELL, "2,5").check().spec?.grid?.cell)
        assertEquals(MissionDraft(), MissionDraft.fromJson("{\"name\":4"))
        assertEquals(MissionDraft(), MissionDraft.fromJson("{\"cell\":\"of another version\"}"))
    }

    @Test
    fun anotherQuantityBringsItsRange() {
        val acidity = triangle.with(DraftField.LARGEST_JUMP, "3").measuring(Quantity.ACIDITY)
        assertEquals("4", acidity.text(DraftField.LOWEST))
        assertEquals("", acidity.text(DraftField.LARGEST_JUMP))
        val depth = triangle.measuring(WHOLE_PROBE).measuring(Quantity.DEPTH)
        val ofDepth = depth.copy(texts = depth.texts - KEPT).check().spec?.probe
        assertEquals(triangle.measuring(Quantity.DEPTH).check().spec?.probe, ofDepth, "conductivity's numbers are gone")
        assertEquals(acidity, acidity.measuring(Quantity.ACIDITY), "what is chosen already changes nothing")
    }

    /** Every number that a probe can have is one that nothing else here has, so that none can be lost or mixed up. */
    @Test
    fun aProbeGoesThroughTheFormAndComesBackWhole() {
        assertEquals(WHOLE_PROBE, triangle.measuring(WHOLE_PROBE).check().spec?.probe)
        val json = Json.encodeToString(ProbeSpec.serializer(), WHOLE_PROBE)
        val draft = triangle.measuring(json)
        assertEquals(WHOLE_PROBE, draft.check().spec?.probe)
        assertEquals(WHOLE_PROBE, MissionDraft.fromJson(draft.toJson()).check().spec?.probe)
        // Over a mission that has a probe of its own, and a probe that says less over one that said more.
        val loaded = MissionDraft.of(Desk.small().let { it.copy(probe = it.probe.copy(stuckAfter = 44)) })
            .with(DraftField.LOWEST_VOLTS, "13.2")
        assertEquals(44, loaded.check().spec?.probe?.stuckAfter)
        assertEquals(WHOLE_PROBE, loaded.measuring(json).check().spec?.probe)
        val plain = ProbeSpec(Quantity.DISSOLVED_OXYGEN, lowest = 1.0, highest = 9.0)
        assertEquals(plain, draft.measuring(plain).check().spec?.probe)
    }

    @Test
    fun aSensorFileSaysHowSlowTheProbeIsAndAProbeFileAllOfIt() {
        val lag = """{"name":"slow","stages":[{"type":"first-order-lag","time_constant_s":9.5}]}"""
        assertEquals(9.5, triangle.measuring(lag).check().spec?.probe?.longestTimeConstant)
        val uneven = """{"name":"u","stages":[{"type":"asymmetric-lag","rising_time_constant_s":4,
            "falling_time_constant_s":12}]}"""
        assertEquals(12.0, triangle.measuring(uneven).check().spec?.probe?.longestTimeConstant)
        val probe = """{"quantity":"temperature","lowest":4,"highest":30}"""
        assertEquals(30.0, triangle.measuring(probe).check().spec?.probe?.highest)
        for (wrong in listOf("", "{}", "[1]", """{"stages":[{"type":"magic"}]}""", """{"quantity":"fish"}""")) {
            val words = assertFailsWith<IllegalArgumentException>(wrong) { triangle.measuring(wrong) }.message.orEmpty()
            assertTrue(words.startsWith("not a ") && words.lines().size == 1, words)
        }
    }

    private fun place(x: Int, y: Int) = PlaceSpec(x.toDouble(), y.toDouble())

    private companion object {
        val WHOLE_PROBE =
            ProbeSpec(Quantity.CONDUCTIVITY, 3, 0.5, 1234.5, 11.5, 7, 0.25, 2.5, 1e-4, 0.125)
        val KEPT = setOf(DraftField.PORT, DraftField.LATENCY, DraftField.SLOWEST)
    }
}
