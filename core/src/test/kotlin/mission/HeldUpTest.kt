package stillwater.mission

import stillwater.control.Danger
import stillwater.model.Position
import kotlin.math.cos
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** A boat that cannot get where it is to go. */
class HeldUpTest {
    private fun spec(changes: (String) -> String = { it }) =
        MissionSpec.fromJson(changes(Desk.SMALL.replace("self-calibrating", "averaging")))

    /** East of [east] m the boat makes no way to the east, as on a bar. */
    private fun barred(spec: MissionSpec, seed: Int, east: Double): Desk {
        val desk = Desk(spec, seed)
        desk.meanwhile = {
            val boat = desk.boat.dynamics
            boat.currentX = if (boat.x > east) -maxOf(0.0, boat.surge * cos(boat.heading)) else 0.0
        }
        desk.until(3.0) { false }
        desk.mission.start()
        return desk
    }

    private fun Desk.distanceHome() =
        Position(boat.dynamics.x, boat.dynamics.y).distanceTo(spec.home.position)

    @Test
    fun theBudgetBringsABoatHomeThatDoesNotReachItsWaypoint() {
        // Less than the minute after which a waypoint is given up is left when the boat comes to the bar.
        val spec = spec { it.replace("900", "75") }.copy(home = PlaceSpec(5.0, 55.0))
        val desk = barred(spec, 491, 9.0)
        assertTrue(desk.until(300.0) { it == MissionState.Returning(Danger.BUDGET_SPENT) }, "${desk.mission.state}")
        assertTrue(desk.mission.used < 75, "used ${desk.mission.used}")
        assertTrue(desk.until(100.0) { it == MissionState.Stopped(StopReason.COMPLETED) }, "${desk.mission.state}")
        assertTrue(desk.mission.used < 75, "used ${desk.mission.used} s of 75")
        assertTrue(desk.distanceHome() < 7.0, "${desk.distanceHome()} m from home")
    }

    /** A boat that lies on a bar uses no metres. */
    @Test
    fun whatLiesBeyondABarIsGivenUpAndTheRestIsSurveyed() {
        val desk = barred(spec { it.replace("\"seconds\":900", "\"metres\":900") }, 492, 24.0)
        assertTrue(desk.until(4000.0) { it is MissionState.Stopped }, "${desk.mission.state}")
        assertEquals(MissionState.Stopped(StopReason.COMPLETED), desk.mission.state)
        val unseen = (0 until 36).filter { it % 6 < 2 && desk.mission.map.readings(it) == 0 }
        assertEquals(emptyList(), unseen)
        assertTrue(desk.mission.givenUp >= 6, "${desk.mission.givenUp} given up")
        assertTrue(desk.distanceHome() < 7.0, "${desk.distanceHome()} m from home")
    }

    /** Weeds in the screw: nowhere to go is no way home either. They come off while the boat rests. */
    @Test
    fun aBoatThatMakesNoWayAtAllRestsItsMotorsAndThenTriesAgain() {
        val desk = Desk(spec(), 493)
        var isHeld = false
        desk.meanwhile = {
            val boat = desk.boat.dynamics
            boat.currentX = if (isHeld) -boat.surge * cos(boat.heading) else 0.0
            boat.currentY = if (isHeld) -boat.surge * sin(boat.heading) else 0.0
        }
        desk.until(3.0) { false }
        desk.mission.start()
        assertTrue(desk.until(120.0) { desk.distanceHome() > 20 })
        isHeld = true
        assertTrue(desk.until(900.0) { it is MissionState.Returning }, "${desk.mission.state}")
        val heldUp = MissionState.Holding(Danger.HELD_UP)
        assertTrue(desk.until(900.0) { it == heldUp }, "${desk.mission.state}")
        assertEquals(600.0, desk.mission.restsFor, 0.1)
        assertTrue(desk.until(1.0) { desk.boat.board.actuation.isAtRest }, "motors run")
        val used = desk.mission.used
        // The first ten minutes, in which the weeds hold on, and then twice as long after three ways.
        assertFalse(desk.until(599.0) { it != heldUp || !desk.boat.board.actuation.isAtRest }, "${desk.mission.state}")
        assertEquals(used, desk.mission.used)
        assertTrue(desk.until(5.0) { it is MissionState.Returning }, "${desk.mission.state}")
        assertTrue(desk.until(300.0) { it == heldUp }, "${desk.mission.state}")
        assertEquals(1200.0, desk.mission.restsFor, 0.1)
        assertTrue(desk.lines.any { "\"why\":\"held_up\"" in it }, desk.lines.last())
        isHeld = false
        assertTrue(desk.until(1500.0) { it is MissionState.Stopped }, "${desk.mission.state}")
        assertEquals(MissionState.Stopped(StopReason.COMPLETED), desk.mission.state)
        assertTrue(desk.distanceHome() < 7.0, "${desk.distanceHome()} m from home")
    }

    /** What is left of a rest goes on, and is no first one. */
    @Test
    fun aRestIsKeptOverARestart() {
        val log = Desk(spec(), 497)
        log.step()
        val step = log.lines.last()
        assertEquals(null, log.replayed().rest)
        val resting = step.replace("\"left_out\":0", "\"left_out\":0,\"rest\":[2,900.5]")
        val found = checkNotNull(Desk.replay(log.lines + resting).recovered())
        assertEquals(HomeRest(2, 900.5), found.rest)
        val desk = Desk(spec(), 498, recovered = found)
        desk.until(3.0) { false }
        assertEquals(2, desk.replayed().rest?.count)
        assertEquals(900.5 - 2.9, checkNotNull(desk.replayed().rest).seconds, 1e-6)
        desk.mission.start()
        assertTrue(desk.until(60.0) { it == MissionState.Surveying }, "nothing calls it home")
        assertEquals(0.0, desk.mission.restsFor)
        desk.mission.logLost()
        assertTrue(desk.until(1.0) { it == MissionState.Holding(Danger.HELD_UP) }, "${desk.mission.state}")
        assertTrue(desk.mission.restsFor in 800.0..897.6, "${desk.mission.restsFor} s")
        // A person's word ends it.
        desk.mission.wish = Wish.RETURN
        assertFalse(desk.until(1.0) { false })
        assertEquals(0.0, desk.mission.restsFor)
        assertEquals(null, desk.replayed().rest)
    }

    /** Away from home it takes a fifth of the time that it takes back. */
    @Test
    fun theBudgetBringsABoatHomeAgainstTheCurrent() {
        for ((seed, planner) in listOf(495 to PlannerName.LAWNMOWER, 496 to PlannerName.BOUNDED_EXTENDED)) {
            val desk = Desk(spec().copy(planner = planner, budget = BudgetSpec(seconds = 400.0)), seed)
            desk.meanwhile = {
                desk.boat.dynamics.currentX = 0.35
                desk.boat.dynamics.currentY = 0.5
            }
            desk.until(3.0) { false }
            desk.mission.start()
            assertTrue(desk.until(1500.0) { it is MissionState.Stopped }, "$planner: ${desk.mission.state}")
            assertEquals(MissionState.Stopped(StopReason.COMPLETED), desk.mission.state)
            assertTrue(desk.mission.used < 400, "$planner: used ${desk.mission.used} s of 400")
            assertTrue(desk.distanceHome() < 7.0, "$planner: ${desk.distanceHome()} m from home")
        }
    }

    /** Three deviations of the place, some 2 m, are kept from the shore, and home counts as reached within 0.5 m. */
    @Test
    fun aHomeInACornerOfTheShoreIsComeTo() {
        val spec = spec { it.replace("900", "150") }
            .copy(home = PlaceSpec(-19.8, -19.8), boat = BoatSpec(arrival = 0.5))
        val desk = barred(spec, 494, 1e9)
        assertTrue(desk.until(400.0) { it == MissionState.Stopped(StopReason.COMPLETED) }, "${desk.mission.state}")
        assertTrue(desk.distanceHome() < 8.0, "${desk.distanceHome()} m from home")
    }
}
