package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.control.Danger
import stillwater.model.BoatTime
import stillwater.model.LatLon
import stillwater.model.Position
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** The failsafe holds in every state: each state against each fault, judged at the board's motors. */
class FailsafeTableTest {
    /** A state and how a mission gets there. */
    private class Case(
        val name: String,
        val policy: String,
        val state: (MissionState) -> Boolean,
        val way: Desk.() -> Unit,
    )

    /** A fault, and how long the motors may go on, s. */
    private class Fault(val name: String, val longest: Double, val strike: Desk.() -> Unit)

    private val cases = listOf(
        Case("idle", "{}", { it == MissionState.Idle }) { until(3.0) { false } },
        Case("preflight", "{}", { it is MissionState.Preflight }) { mission.start() },
        Case("arming", "{}", { it == MissionState.Arming }) { begin() },
        Case("surveying", "{}", { it == MissionState.Surveying }) { begin() },
        Case(
            "holding",
            """{"battery":"hold","lowest_volts":14}""",
            { it == MissionState.Holding(Danger.BATTERY_LOW) },
        ) {
            begin()
            until(30.0) { false }
            boat.board.volts = 12.0
        },
        Case("holding at the end", """{"end":"hold"}""", { it == MissionState.Holding(Danger.MISSION_END) }) {
            begin()
        },
        Case("returning", """{"lowest_volts":14}""", { it == MissionState.Returning(Danger.BATTERY_LOW) }) {
            begin()
            until(60.0) { false }
            boat.board.volts = 12.0
        },
        Case("budget spent", "{}", { it == MissionState.Returning(Danger.BUDGET_SPENT) }) { begin() },
        Case("stopped", "{}", { it is MissionState.Stopped }) {
            begin()
            until(30.0) { false }
            mission.stop()
        },
    )

    private val faults = listOf(
        // The bar of 0.6 s.
        Fault("link lost", 0.6) { boat.link.isCut = true },
        Fault("operator", 0.2) { mission.stop() },
        // The oldest fix is of 3 s, and one may just have come; a step and the link's delay.
        Fault("no fixes", 3.3) { meanwhile = { boat.takeFix() } },
        // The third fix a second apart that lies where the boat cannot be.
        Fault("fixes jump", 3.3) {
            meanwhile = { if (boat.takeFix() != null) mission.fix(boat.time, LatLon(46.0, -73.0)) }
        },
        Fault("fixes of a clock in the future", 3.3) {
            meanwhile = { if (boat.takeFix() != null) mission.fix(BoatTime(Double.POSITIVE_INFINITY), HERE) }
        },
        Fault("board reset", 0.2) { boat.board.reset() },
    )

    private fun spec(policy: String, seconds: Int) = MissionSpec.fromJson(
        Desk.SMALL.replace("900", "$seconds")
            .replace("self-calibrating", "averaging")
            .replace(""""home":""", """"failsafe":$policy,"home":"""),
    )

    private fun Desk.begin() {
        until(3.0) { false }
        mission.start()
    }

    @Test
    fun motorsRestInTimeInEveryState() {
        for (case in cases) {
            for (fault in faults) {
                val desk = Desk(spec(case.policy, 150), 441)
                case.way(desk)
                assertTrue(desk.until(400.0, case.state), "${case.name} is reached, not ${desk.mission.state}")
                fault.strike(desk)
                val what = "${fault.name} while ${case.name}"
                val count = (fault.longest * 10).toInt()
                repeat(count) { desk.step() }
                assertTrue(desk.boat.board.actuation.isAtRest, "$what: at rest after ${fault.longest} s")
                if (fault.name == "board reset") continue
                repeat(50) {
                    desk.step()
                    assertTrue(desk.boat.board.actuation.isAtRest, "$what: still at rest, ${desk.mission.state}")
                }
            }
        }
    }

    @Test
    fun theBudgetBringsTheBoatHomeInAStateOfItsOwnAndThenThePolicyHolds() {
        val ends = mapOf(
            "return-home" to MissionState.Stopped(StopReason.COMPLETED),
            "stop" to MissionState.Stopped(StopReason.COMPLETED),
            "hold" to MissionState.Holding(Danger.MISSION_END),
        )
        for ((policy, end) in ends) {
            val desk = Desk(spec("""{"end":"$policy"}""", 200), 451)
            desk.begin()
            assertTrue(desk.until(200.0) { it == MissionState.Returning(Danger.BUDGET_SPENT) }, policy)
            assertTrue(desk.until(200.0) { it == end }, "$policy ends ${desk.mission.state}")
            assertTrue(desk.mission.used <= 200.0, "$policy: used ${desk.mission.used} s")
            desk.until(20.0) { false }
            assertEquals(end, desk.mission.state)
            val boat = desk.boat.dynamics.run { Position(x, y) }
            // Three arrival radii, within which a waypoint counts as passed, and three deviations of the track.
            assertTrue(boat.distanceTo(desk.spec.home.position) < 4.5 + 3 * 0.8, "$policy: at $boat")
        }
    }

    /** The process died with the board armed and driving; it says ten times a second that its motors run. */
    @Test
    fun aBoardLeftArmedIsDisarmedAsSoonAsItIsHeard() {
        val desk = Desk(Desk.small(), 461)
        desk.begin()
        assertTrue(desk.until(60.0) { !desk.boat.board.actuation.isAtRest })
        val next = Mission(desk.spec, desk.boat.phone, desk.log)
        repeat(3) {
            next.step(BoatTime(desk.boat.time.seconds + 1))
            desk.boat.advance(0.1)
        }
        assertTrue(desk.boat.board.actuation.isAtRest)
    }

    private companion object {
        val HERE = LatLon(45.5, -73.6)
    }
}
