package stillwater.control

import org.junit.jupiter.api.Test
import stillwater.model.Actuation
import stillwater.model.Drive
import stillwater.model.Position
import stillwater.virtual.BoatDynamics
import stillwater.virtual.Hull
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class SafetyGateTest {
    private val square = listOf(Position(0.0, 0.0), Position(50.0, 0.0), Position(50.0, 50.0), Position(0.0, 50.0))
    private val fence = Fence(square)
    private val full = Drive(1.0, 0.2)

    private fun gate(settings: SafetySettings = SafetySettings(lowestVolts = 11.0)) = SafetyGate(settings, fence)

    private fun sound() = Situation().apply {
        linkAge = 0.1
        fixAge = 0.5
        x = 25.0
        y = 25.0
        deviation = 0.5
        heading = 0.0
        volts = 12.0
    }

    private fun ruled(gate: SafetyGate, situation: Situation, drive: Drive = full) =
        gate.permit(drive, situation, gate.assess(situation))

    @Test
    fun aSoundBoatDrivesAsAsked() {
        val gate = gate()
        assertEquals(Ruling.GoOn, gate.assess(sound()))
        assertEquals(full, ruled(gate, sound()))
        assertEquals(Drive(1.0, -1.0), ruled(gate, sound(), Drive(7.0, -9.0)))
    }

    @Test
    fun everyDangerIsNamedAndTheBlindOnesRestTheMotorsWhateverThePolicy() {
        val answers = Danger.entries.associateWith { Failsafe.RETURN_HOME }
        val home = SafetySettings(lowestVolts = 11.0, lowFor = 0.0, lowestPhonePercent = 15.0, answers = answers)
        val blind = mapOf<Danger, Situation.() -> Unit>(
            Danger.LINK_LOST to { linkAge = 0.6 },
            Danger.FIX_STALE to { fixAge = 3.5 },
            Danger.FIX_JUMPING to { jumps = 3 },
        )
        for ((danger, change) in blind) {
            val situation = sound().apply(change)
            assertEquals(Ruling.Fall(danger, Failsafe.STOP), gate(home).assess(situation))
            assertEquals(Drive.NONE, ruled(gate(home), situation))
            assertEquals(Drive.NONE, gate(home).permit(full, situation, Ruling.GoOn), "$danger, asked too late")
        }
        val seeing = mapOf<Danger, Situation.() -> Unit>(
            Danger.OPERATOR_STOP to { operatorStop = true },
            Danger.FENCE to { x = -1.0 },
            Danger.BATTERY_LOW to { volts = 10.9 },
            Danger.PHONE_LOW to { phonePercent = 14.0 },
            Danger.LOG_LOST to { logLost = true },
            Danger.OPERATOR_WAIT to { operatorWish = Danger.OPERATOR_WAIT },
            Danger.OPERATOR_HOLD to { operatorWish = Danger.OPERATOR_HOLD },
            Danger.OPERATOR_RETURN to { operatorWish = Danger.OPERATOR_RETURN },
            Danger.MISSION_END to { missionEnded = true },
        )
        for ((danger, change) in seeing) {
            assertEquals(Ruling.Fall(danger, Failsafe.RETURN_HOME), gate(home).assess(sound().apply(change)))
        }
        assertEquals(
            Ruling.Fall(Danger.OPERATOR_STOP, Failsafe.STOP),
            gate().assess(sound().apply { operatorStop = true }),
            "what the policy does not name stops",
        )
    }

    @Test
    fun whatIsUnknownIsADanger() {
        assertEquals(Drive.NONE, ruled(gate(), Situation()))
        for (change in listOf<Situation.() -> Unit>(
            { linkAge = Double.NaN },
            { fixAge = Double.NaN },
            { x = Double.NaN },
            { heading = Double.NaN },
            { deviation = Double.NaN },
        )) {
            assertEquals(Drive.NONE, ruled(gate(), sound().apply(change)))
        }
        val gate = gate()
        assertEquals(Drive.NONE, ruled(gate, sound(), Drive(Double.NaN, 0.0)))
        assertEquals(Drive.NONE, ruled(gate, sound(), Drive(0.0, Double.NEGATIVE_INFINITY)))
        assertEquals(2, gate.notFinite)
    }

    @Test
    fun aBatteryThatSagsForAMomentIsNotLowAndOneThatIsLowStaysSo() {
        val gate = gate()
        fun at(second: Int, volts: Double) = gate.assess(
            sound().apply {
                seconds = second.toDouble()
                this.volts = volts
            },
        )
        for (second in 0..9) assertEquals(Ruling.GoOn, at(second, 10.5))
        assertEquals(Ruling.GoOn, at(10, 11.5))
        for (second in 11..20) assertEquals(Ruling.GoOn, at(second, 10.5))
        assertEquals(Ruling.Fall(Danger.BATTERY_LOW, Failsafe.RETURN_HOME), at(21, 10.5))
        assertEquals(Ruling.Fall(Danger.BATTERY_LOW, Failsafe.RETURN_HOME), at(22, 13.0))
    }

    @Test
    fun aBoatThatIsHeldUpRestsUnlessItIsBeyondTheFenceOrIsToStop() {
        val gate = gate()
        fun ruling(
            change: Situation.() -> Unit,
        ) = gate.assess(sound().apply { heldUp = true }.apply(change)) as Ruling.Fall
        val back = sound().apply { heldUp = true }
        assertEquals(Ruling.GoOn, gate.assess(back), "back within the fence, nothing else calls it")
        assertEquals(Danger.HELD_UP, ruling { budgetSpent = true }.danger)
        assertEquals(Danger.FENCE, ruling { x = 51.0 }.danger)
        assertEquals(Danger.OPERATOR_STOP, ruling { operatorStop = true }.danger)
    }

    /** Each is wide of the fence by more than its stopping distance, and would pass but for the doubt. */
    @Test
    fun aPlaceThatIsDoubtedIsKeptFromTheFenceByAsMuch() {
        val gate = gate()
        val near = sound().apply { x = 47.0 }
        assertEquals(full, ruled(gate, near))
        assertEquals(Drive(0.0, 0.2), ruled(gate, near.apply { doubt = 2.0 }))
        val beyond = sound().apply {
            x = 52.0
            heading = PI
        }
        assertEquals(1.0, ruled(gate, beyond).forward, "led back within the margin")
        assertEquals(Drive.NONE, ruled(gate, beyond.apply { doubt = 2.0 }))
    }

    @Test
    fun atTheFenceOnlyThrustInwardsPassesAndBeyondTheMarginNone() {
        val gate = gate()
        val near = sound().apply {
            x = 49.0
            velocityX = 1.0
        }
        assertEquals(Drive(0.0, 0.2), ruled(gate, near))
        near.heading = -0.75 * PI
        assertEquals(Drive(1.0, -0.2), ruled(gate, near), "turned to where inwards is")
        assertEquals(Drive(0.0, -0.2), ruled(gate, near, Drive(-1.0, 0.2)), "astern is outwards here")
        assertEquals(Drive(1.0, -0.2), ruled(gate, near.apply { x = 53.0 }), "led back within the margin")
        assertEquals(Drive.NONE, ruled(gate, near.apply { x = 55.1 }))
    }

    @Test
    fun aBoatDrivenAtTheFenceByAMadPilotStaysWithinIt() {
        mad(401, fence)
        val west = listOf(Position(8.0, 8.0), Position(20.0, 8.0), Position(20.0, 20.0))
        val east = listOf(Position(32.0, 28.0), Position(48.0, 36.0), Position(30.0, 44.0))
        mad(402, Fence(square, listOf(west, east)))
    }

    private fun mad(seed: Int, fence: Fence) {
        val random = Random(seed)
        val hull = Hull()
        // T = m / d1, an upper bound of the time constant; the drag's square only shortens it.
        val settings = SafetySettings(stopTime = hull.mass / hull.linearDrag)
        repeat(50) {
            val gate = SafetyGate(settings, fence)
            val boat = BoatDynamics(hull, x = 25.0, y = 25.0, heading = random.nextDouble(-PI, PI))
            val situation = sound()
            situation.deviation = 0.1
            var mad = full
            var farthest = Double.POSITIVE_INFINITY
            for (tick in 0 until 2000) {
                if (tick % 30 == 0) mad = Drive(random.nextDouble(-1.0, 2.0), random.nextDouble(-0.5, 0.5))
                situation.x = boat.x
                situation.y = boat.y
                situation.heading = boat.heading
                situation.velocityX = boat.surge * cos(boat.heading)
                situation.velocityY = boat.surge * sin(boat.heading)
                val drive = gate.permit(mad, situation, Ruling.GoOn)
                boat.advance(0.1, Mixing.DIFFERENTIAL.mix(drive))
                farthest = minOf(farthest, fence.distance(boat.x, boat.y))
            }
            assertTrue(farthest > 0, "seed $seed, run $it: $farthest m")
        }
    }

    @Test
    fun aKeepOutIsAFenceFromOutside() {
        val island = listOf(Position(20.0, 20.0), Position(30.0, 20.0), Position(30.0, 30.0), Position(20.0, 30.0))
        val beside = listOf(Position(28.0, 22.0), Position(40.0, 22.0), Position(40.0, 28.0), Position(28.0, 28.0))
        val both = Fence(square, listOf(island, beside.reversed()))
        assertEquals(4.0, both.distance(24.0, 16.0), 1e-12)
        assertEquals(-1.0, both.inwardY, 1e-12)
        assertEquals(3.0, both.distance(3.0, 25.0), 1e-12)
        assertEquals(-4.0, both.distance(24.0, 25.0), 1e-12)
        assertEquals(-1.0, both.inwardX, 1e-12)
        assertEquals(-3.0, both.distance(35.0, 25.0), 1e-12)
        assertEquals(-2.0, both.distance(52.0, 25.0), 1e-12)
        val gate = SafetyGate(SafetySettings(fenceMargin = 3.0), both)
        val ashore = sound().apply {
            x = 21.0
            heading = PI
            deviation = 0.1
        }
        assertEquals(Danger.FENCE, (gate.assess(ashore) as Ruling.Fall).danger)
        assertEquals(Drive(1.0, 0.2), ruled(gate, ashore), "led out")
        assertEquals(Drive.NONE, ruled(gate, ashore.apply { deviation = 0.8 }), "it may be 3.4 m within")
    }

    @Test
    fun theFenceKnowsInsideFromOutsideWhicheverWayRound() {
        val shape = listOf(Position(0.0, 0.0), Position(40.0, 0.0), Position(40.0, 40.0), Position(20.0, 10.0))
        for (corners in listOf(shape, shape.reversed())) {
            val notched = Fence(corners)
            assertTrue(notched.distance(30.0, 15.0) > 0)
            assertTrue(notched.distance(10.0, 20.0) < 0)
            assertEquals(-5.0, notched.distance(45.0, 20.0), 1e-12)
            assertEquals(-1.0, notched.inwardX, 1e-12)
            assertTrue(notched.distance(Double.NaN, 0.0).isNaN())
        }
        val at = Actuation.Differential(0.0, 0.0)
        assertTrue(at.isAtRest)
    }
}
