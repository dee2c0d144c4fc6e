package stillwater.world

import org.junit.jupiter.api.Test
import stillwater.model.Actuation
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.LatLon
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.virtual.Hull
import stillwater.virtual.PoseSpec
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

class VirtualWorldTest {
    private val grid = Grid(Position(20.0, -10.0), 7, 5, 8.0, rotation = 0.4)
    private val site = WorldSite(LatLon(45.5, -73.6), grid, Interval(0.0, 15.0), grid.center(3))
    private val windy = WorldSettings(
        seed = 12,
        wind = Flow(3.0, 1.0),
        current = Flow(0.2, 0.0),
        currentTurn = 40.0,
        pose = PoseSpec(wander = 2.0),
    )

    /** All that a phone would see of [world] in a minute, asked every [step] s. */
    private fun seen(world: VirtualWorld, step: Double): List<Any?> {
        val bytes = ByteArray(4096)
        val heard = StringBuilder()
        repeat((60 / step).toInt()) {
            world.advance(step)
            val count = world.boat.phone.read(bytes)
            if (count > 0) heard.append(bytes.decodeToString(0, count))
        }
        return listOf(heard.toString(), world.boat.takeFix(), world.boat.dynamics.x, world.battery.used)
    }

    /** A boat that nothing drives is carried by the current, which its probe does not feel, and by the wind, which it does. */
    @Test
    fun theProbeIsToldTheSpeedThroughTheWater() {
        val passing = Hull().windage * hypot(windy.wind.east, windy.wind.north)
        val follows = SensorSpec("follows", listOf(SensorStage.Cross(Conditions.SPEED, 0.0, 10.0)))
        val isOff = SensorSpec("is off", listOf(SensorStage.Calibration(1.0, 10 * passing)))
        assertEquals(
            seen(VirtualWorld(windy.copy(sensor = isOff), site), 0.1),
            seen(VirtualWorld(windy.copy(sensor = follows), site), 0.1),
        )
    }

    @Test
    fun theSameSeedGivesTheSameBytesHoweverTimePasses() {
        val once = seen(VirtualWorld(windy, site), 0.1)
        assertEquals(once, seen(VirtualWorld(windy, site), 0.1))
        assertEquals(once, seen(VirtualWorld(windy, site), 0.25))
        assertNotEquals(once, seen(VirtualWorld(windy.copy(seed = 13), site), 0.1))
    }

    @Test
    fun theCurrentTurnsRoundAndTheWindCarriesTheBoat() {
        val world = VirtualWorld(windy.copy(wind = Flow.NONE), site)
        world.advance(10.0)
        // A quarter turn counter-clockwise: from east to north. One tick of 0.02 s is 0.003 rad.
        assertEquals(0.0, world.boat.dynamics.currentX, 0.2 * 0.004)
        assertEquals(0.2, world.boat.dynamics.currentY, 1e-5)
        val still = VirtualWorld(windy.copy(current = Flow.NONE), site)
        still.advance(10.0)
        assertEquals(site.start.x + 10 * 0.03 * 3, still.boat.dynamics.x, 1e-6)
    }

    @Test
    fun theBatteryIsUsedAndItsVoltageFalls() {
        val world = VirtualWorld(WorldSettings(battery = BatterySpec(capacity = 1.0, idlePower = 3600.0)), site)
        world.advance(0.5)
        // 3600 W for half a second of one watt hour is half of it.
        assertEquals(0.5, world.battery.used, 1e-9)
        assertEquals(15.3 * (1 - 1 / 12.0), world.boat.board.volts, 1e-6)
        assertNull(world.emptySince)
        world.advance(0.5)
        // To a tick, 1/50 of the capacity here, by which the voltage is on its way from 3.5 to 3.0 of 4.2 V or there.
        assertEquals(1.0, assertNotNull(world.emptySince).seconds, 0.021)
        world.advance(5.0)
        assertEquals(15.3 * 3.0 / 4.2, world.boat.board.volts, 1e-9)
    }

    @Test
    fun theVoltageOfAnEmptyBatteryFallsOnByWhatTheElectronicsDraw() {
        val battery = Battery(BatterySpec(capacity = 100.0, idlePower = 10.0, fullPower = 300.0), fullVolts = 16.8)
        val full = Actuation.Differential(1.0, 1.0)
        battery.advance(3600.0 * 100 / 310 + 1e-6, full)
        assertTrue(battery.isEmpty)
        assertEquals(14.0, battery.volts, 1e-6)
        // Motors draw no more: half of the last watt hour is three minutes of 10 W.
        battery.advance(180.0, full)
        assertEquals(100.5, battery.used, 1e-6)
        assertEquals(13.0, battery.volts, 1e-6)
        battery.advance(3600.0, full)
        assertEquals(12.0, battery.volts, 1e-9)
    }

    @Test
    fun aBoatWithAnEmptyBatteryDrifts() {
        val settings = WorldSettings(
            current = Flow(0.0, 0.2),
            board = BoardSpec(Firmware.MASTER, arming = 1.0),
            battery = BatterySpec(capacity = 1.0, idlePower = 10.0, fullPower = 300.0),
        )
        for (isVectored in listOf(false, true)) {
            val world = VirtualWorld(settings, site.copy(isVectored = isVectored))
            val ahead = if (isVectored) """{"m0":{"v":1.0},"s0":{"p":0.5}}""" else """{"m0":{"v":1.0},"m1":{"v":1.0}}"""
            fun sail(seconds: Int) = repeat(10 * seconds) {
                world.boat.phone.write("$ahead\r\n".encodeToByteArray())
                world.advance(0.1)
            }
            sail(8)
            assertNull(world.emptySince)
            assertTrue(world.boat.dynamics.surge > 0.5, "under way at ${world.boat.dynamics.surge} m/s")
            // 310 W use a watt hour in 12 s.
            sail(60)
            assertNotNull(world.emptySince)
            val before = world.boat.dynamics.y
            sail(10)
            // A hull of 15 kg and 5 N per m/s loses its way within e^-1 in 3 s at the latest: in 45 s all of it.
            assertEquals(0.0, world.boat.dynamics.surge, 1e-5)
            assertEquals(0.0, world.boat.dynamics.yawRate, 1e-5)
            assertEquals(10 * 0.2, world.boat.dynamics.y - before, 1e-3)
        }
    }

    @Test
    fun smoothWaterIsTheGaussiansAtTheCentresAndHasNoSteps() {
        val range = Interval(2.0, 12.0)
        val stepped = WaterKind.GAUSSIAN.draw(grid, range, Random(5))
        val smooth = WaterKind.SMOOTH.draw(grid, range, Random(5))
        val now = BoatTime(0.0)
        for (cell in 0 until grid.size) {
            val centre = grid.center(cell)
            assertEquals(stepped.truth(centre.x, centre.y, now), smooth.truth(centre.x, centre.y, now), 1e-9)
        }
        // Amplitudes of at most 6, sigma of at least a cell of 8 m: the slope is at most 6 e^-1/2 / 8 a metre of the
        // mixture before scaling; the steps between cells are far larger than a centimetre's change.
        var largest = 0.0
        var step = 0.0
        repeat(4000) { i ->
            val x = 20 + 0.01 * i
            largest = maxOf(largest, abs(smooth.truth(x + 0.01, 5.0, now) - smooth.truth(x, 5.0, now)))
            step = maxOf(step, abs(stepped.truth(x + 0.01, 5.0, now) - stepped.truth(x, 5.0, now)))
        }
        assertTrue(largest < 0.05 && step > 10 * largest, "smooth $largest, stepped $step a centimetre")
    }

    @Test
    fun waterLiesInItsRangeAndIsDefinedEverywhere() {
        for (kind in WaterKind.entries) {
            val range = Interval(2.0, 12.0)
            val field = kind.draw(grid, range, Random(6))
            for (cell in 0 until grid.size) {
                val centre = grid.center(cell)
                assertTrue(field.truth(centre.x, centre.y, BoatTime(0.0)) in range, "$kind in cell $cell")
            }
            assertTrue(field.truth(1000.0, -500.0, BoatTime(0.0)).isFinite(), "$kind far off")
        }
    }

    @Test
    fun aCellsMeanIsItsValueWhereTheWaterIsEvenInIt() {
        val even = VirtualWorld(WorldSettings(seed = 3), site)
        val uneven = VirtualWorld(WorldSettings(seed = 3, water = WaterKind.SMOOTH), site)
        for (cell in 0 until grid.size) assertEquals(even.truthAtCentre(cell), even.meanTruth(cell), 1e-9)
        assertTrue((0 until grid.size).any { abs(uneven.truthAtCentre(it) - uneven.meanTruth(it)) > 0.01 })
    }
}
