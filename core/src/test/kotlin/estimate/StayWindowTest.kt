package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** The bounded filter decides by its windows' slopes, whether it takes them or not: the same map, bit for bit. */
class StayWindowTest {
    private val grid = Grid.unit(3, 1)

    /** The filter as it is written down: each reading by itself, each slope taken. */
    private inner class ByTheBook(private val settings: BoundedFilterSettings) {
        val map = FieldMap(grid, Interval.UNIT)
        private val medians = MedianWindow(settings.medianWindow)
        private val slopes = SlopeWindow(settings.slopeWindow)
        private var last = Grid.OUTSIDE

        fun take(x: Double, seconds: Double, value: Double) {
            val cell = grid.cellAt(x, 0.5)
            val entered = cell != last
            last = cell
            if (cell == Grid.OUTSIDE) return map.countOutside()
            if (entered) map.countVisit(cell)
            map.countReading(cell)
            if (entered && settings.clearOnEntry) {
                medians.clear()
                slopes.clear()
            }
            medians.add(seconds, value)
            if (!medians.full) return
            slopes.add(medians.time, medians.median)
            if (!slopes.full) return
            val slope = slopes.slope()
            if (slope > settings.epsilon && value > map.lower(cell)) {
                if (value > map.upper(cell)) map.countConflict(cell)
                believe(cell, value, map.upper(cell))
            } else if (slope < -settings.epsilon && value < map.upper(cell)) {
                if (value < map.lower(cell)) map.countConflict(cell)
                believe(cell, map.lower(cell), value)
            }
        }

        private fun believe(cell: Int, lower: Double, upper: Double) {
            map.setBounds(cell, lower, upper)
            map.setValue(cell, lower / 2 + upper / 2)
        }
    }

    /** What readings are like for a while: how they come, and of what size and resolution they are. */
    private class Stretch(random: Random, scale: Double) {
        private val jitter = random.nextInt(3) == 0
        private val step = listOf(1.0, 0.1, 1.0 / 3, 60.0, 0.0, 1e-60).random(random)
        private val resolution = if (random.nextBoolean()) 0.005 * scale else 0.0
        private val offset = if (random.nextInt(4) == 0) 1e3 * scale else 0.0
        private val noise = listOf(0.0, 0.004, 0.1).random(random) * scale
        private var level = random.nextDouble() * scale

        fun step(random: Random) = if (jitter) step * random.nextDouble(0.5, 2.0) else step

        fun value(random: Random): Double {
            level += noise * (random.nextDouble() - 0.5)
            val value = if (resolution > 0) Math.round(level / resolution) * resolution else level
            val rounded = if (random.nextInt(8) == 0) Math.nextUp(value) else value
            return rounded + offset
        }
    }

    @Test
    fun rampsAsSteepAsEpsilonAreDecidedByTheSlopeItself() {
        val answers = IntArray(3)
        forEvery(drawn { it.nextLong() }, cases = 2000) { seed ->
            val random = Random(seed)
            // Steps that no sum of them rounds, and of any size, as the values are.
            val step = random.nextInt(1, 64) * 2.0.pow(if (random.nextBoolean()) 0 else random.nextInt(-400, 400))
            val scale = 10.0.pow(if (random.nextBoolean()) 0 else random.nextInt(-320, 300))
            val rate = random.nextDouble() * scale / step
            val epsilon = if (rate <= Double.MAX_VALUE) rate else 0.0
            val offset = random.nextDouble() * scale
            val window = StayWindow(epsilon)
            val medians = MedianWindow(StayWindow.MEDIANS)
            val slopes = SlopeWindow(StayWindow.SLOPES)
            val held = ArrayList<Int>()
            // A ramp and a number of last digits, back and forth for longer than the window holds.
            for (i in 0 until 150) {
                val even = if (i / 30 % 2 == 0) i % 30 else 30 - i % 30
                val value = offset + even * (epsilon * step)
                val near = value + random.nextInt(-1, 2) * Math.ulp(value)
                if (i == 0) window.pace(step, 100 * scale)
                medians.add(i * step, near)
                if (medians.full) slopes.add(medians.time, medians.median)
                val slope = if (slopes.full) slopes.slope() else 0.0
                val expected = (if (slope > epsilon) 1 else 0) - (if (slope < -epsilon) 1 else 0)
                window.hold(i * step, near)
                held.add(expected)
                answers[expected + 1]++
                if (!window.isFull && random.nextInt(8) > 0) continue
                window.look(Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY)
                val seen = window.seen until window.size
                assertEquals(held, seen.map(window::direction), "$seed, to reading $i")
                val (rising, falling) = listOf(1, -1).map { way -> seen.filter { held[it - seen.first] == way } }
                assertEquals(rising.maxOfOrNull(window::value) ?: Double.NEGATIVE_INFINITY, window.highest, "$seed, $i")
                assertEquals(falling.minOfOrNull(window::value) ?: Double.POSITIVE_INFINITY, window.lowest, "$seed, $i")
                window.release()
                held.clear()
            }
        }
        assertTrue(answers.all { it > 10_000 }, answers.joinToString())
    }

    @Test
    fun mapsAreThoseOfTheSlopes() {
        var conflicts = 0
        forEvery(drawn { it.nextLong() }, cases = 600) { seed ->
            val random = Random(seed)
            // From where products vanish to where they overflow, but mostly neither.
            val scale = if (random.nextInt(3) >
                0
            ) {
                1.0
            } else {
                listOf(1e-310, 1e-160, 1e-30, 1e40, 1e60, 1e160).random(random)
            }
            val settings = BoundedFilterSettings(
                epsilon = listOf(0.0, 0.0005, 0.002, 0.02).random(random) * scale,
                clearOnEntry = random.nextInt(3) > 0,
            )
            val book = ByTheBook(settings)
            val filter = BoundedFilter(grid, Interval.UNIT, settings)
            play(random, scale, filter, book)
            assertSame(book.map, filter.map)
            conflicts += book.map.conflicts(1)
        }
        assertTrue(conflicts > 1000, "$conflicts")
    }

    private fun play(random: Random, scale: Double, filter: BoundedFilter, book: ByTheBook) {
        var seconds = 0.0
        repeat(8) {
            val stretch = Stretch(random, scale)
            repeat(6) {
                // Now and then off the grid, or a long stay.
                val x = random.nextInt(4) + 0.25 + 0.5 * random.nextInt(2)
                val count = if (random.nextInt(8) == 0) random.nextInt(60, 150) else random.nextInt(1, 14)
                val times = DoubleArray(count)
                val values = DoubleArray(count)
                for (i in 0 until count) {
                    seconds += stretch.step(random)
                    times[i] = seconds
                    values[i] = stretch.value(random)
                    book.take(x, seconds, values[i])
                }
                if (random.nextBoolean()) {
                    filter.updateAll(times, x, 0.5, values, count)
                } else {
                    for (i in 0 until count) {
                        filter.update(BoatTime(times[i]), x, 0.5, values[i], Conditions.NONE)
                        // To be asked for the map in the middle of a stay changes nothing.
                        if (random.nextInt(16) == 0) filter.map
                    }
                }
            }
        }
    }

    private fun assertSame(expected: FieldMap, map: FieldMap) {
        for (cell in 0 until grid.size) {
            assertEquals(expected.lower(cell).toRawBits(), map.lower(cell).toRawBits())
            assertEquals(expected.upper(cell).toRawBits(), map.upper(cell).toRawBits())
            assertEquals(expected.value(cell).toRawBits(), map.value(cell).toRawBits())
            assertEquals(expected.visits(cell), map.visits(cell))
            assertEquals(expected.readings(cell), map.readings(cell))
            assertEquals(expected.conflicts(cell), map.conflicts(cell))
        }
        assertEquals(expected.outside, map.outside)
    }
}
