package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.control.Danger
import stillwater.control.Failsafe
import stillwater.control.Ruling
import stillwater.model.LatLon
import stillwater.virtual.LinkSpec
import stillwater.wire.BoardState
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What goes wrong afloat, at random and all at once; seeds fixed before the first run. */
class FaultsTest {
    private class Faults(private val desk: Desk, private val random: Random) {
        private var cutUntil = -1.0
        var lost = 0.0
            private set

        fun strike() {
            val now = desk.boat.time.seconds
            if (random.nextDouble() < 0.004) cutUntil = now + random.nextDouble(0.1, 15.0)
            desk.boat.link.isCut = now < cutUntil
            lost = if (now < cutUntil) lost + 0.1 else 0.0
            if (random.nextDouble() < 0.002) desk.boat.board.reset()
            if (random.nextDouble() < 0.005) desk.mission.fix(desk.boat.time, FAR)
            if (random.nextDouble() < 0.005) desk.mission.compass(desk.boat.time, Double.NaN, Double.NaN)
            if (random.nextDouble() < 0.02) desk.boat.takeFix()
            if (random.nextDouble() < 0.01) desk.boat.link.board.write(random.nextBytes(random.nextInt(1, 60)))
            if (random.nextDouble() < 0.002) desk.boat.link.board.write(NOT_A_NUMBER.encodeToByteArray())
        }
    }

    @Test
    fun motorsRestWithoutALinkAndTheBoatStaysInsideTheFence() {
        var goneOn = 0
        for (seed in 501..530) {
            val random = Random(seed)
            val desk = Desk(Desk.small(), seed, LinkSpec(loss = 1e-3, corruption = 1e-3))
            desk.until(3.0) { false }
            desk.mission.start()
            val faults = Faults(desk, random)
            desk.meanwhile = {
                faults.strike()
                // The bar of 0.6 s; a cut counts 0.1 s as it begins.
                if (faults.lost >
                    0.65
                ) {
                    assertTrue(desk.boat.board.actuation.isAtRest, "seed $seed: driven without a link")
                }
                val out = desk.boat.dynamics.run { maxOf(-x, -y, x - 60, y - 60) }
                assertTrue(out < 20.0, "seed $seed: $out m outside of the grid")
            }
            desk.until(300.0) { false }
            assertTrue(desk.mission.refusedFixes > 0 && desk.mission.board.unreadable > 0)
            desk.replayed().let { assertEquals(desk.mission.readings.passed, it.readings) }
            if (desk.mission.map.let { map -> (0 until 36).count { map.readings(it) > 0 } } > 4) goneOn++
        }
        // A cut every 25 s for 8 s on average, and arming after the long ones: some get along slowly.
        assertTrue(goneOn >= 20, "$goneOn of 30 went on")
    }

    @Test
    fun eachDangerLeadsToItsState() {
        fun next(state: MissionState, danger: Danger, failsafe: Failsafe, isHome: Boolean = false) =
            MissionPhases.next(state, PhaseInput(Ruling.Fall(danger, failsafe), BoardState.ACTIVE, isHome, true))
        val under = MissionState.Surveying
        assertEquals(MissionState.Holding(Danger.LINK_LOST), next(under, Danger.LINK_LOST, Failsafe.STOP))
        assertEquals(MissionState.Holding(Danger.BATTERY_LOW), next(under, Danger.BATTERY_LOW, Failsafe.HOLD))
        assertEquals(MissionState.Stopped(StopReason.BATTERY), next(under, Danger.BATTERY_LOW, Failsafe.STOP))
        assertEquals(MissionState.Returning(Danger.FENCE), next(under, Danger.FENCE, Failsafe.RETURN_HOME, true))
        assertEquals(MissionState.Stopped(StopReason.FENCE), next(under, Danger.FENCE, Failsafe.STOP))
        assertEquals(
            MissionState.Stopped(StopReason.COMPLETED),
            next(MissionState.Returning(Danger.MISSION_END), Danger.MISSION_END, Failsafe.RETURN_HOME, true),
        )
        val idle: MissionState = MissionState.Idle
        assertEquals(idle, next(idle, Danger.OPERATOR_STOP, Failsafe.STOP))
        for (state in listOf(
            MissionState.Preflight(null),
            MissionState.Arming,
            under,
            MissionState.Holding(Danger.FENCE),
        )) {
            assertEquals(
                MissionState.Stopped(StopReason.OPERATOR),
                next(state, Danger.OPERATOR_STOP, Failsafe.STOP),
            )
        }
        assertEquals(
            MissionState.Preflight(Danger.FIX_STALE),
            next(MissionState.Preflight(null), Danger.FIX_STALE, Failsafe.STOP),
        )
        assertEquals(MissionState.Stopped(StopReason.LOG_LOST), next(under, Danger.LOG_LOST, Failsafe.STOP))
        for (wish in listOf(Danger.OPERATOR_WAIT, Danger.OPERATOR_HOLD, Danger.OPERATOR_RETURN)) {
            val armed: MissionState = MissionState.Arming
            assertEquals(armed, next(MissionState.Preflight(null), wish, Failsafe.STOP), "$wish lets it arm")
        }
    }

    @Test
    fun aBoardThatDisarmedItselfIsArmedAgainOnlyWhereThePolicySaysSo() {
        fun next(rearms: Boolean) =
            MissionPhases.next(MissionState.Surveying, PhaseInput(Ruling.GoOn, BoardState.STANDBY, false, rearms))
        assertEquals(MissionState.Arming, next(rearms = true))
        assertEquals(MissionState.Stopped(StopReason.DISARMED), next(rearms = false))
    }

    private companion object {
        val FAR = LatLon(46.0, -73.0)
        const val NOT_A_NUMBER = "{\"s1\":{\"type\":\"atlas_do\",\"data\":\"nan\"}}\r\n"
    }
}
