package stillwater.contract

import org.junit.jupiter.api.Test
import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.CrossingPolicy
import stillwater.field.CellField
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** The one promise of the bounded filter, and what is left of it without its assumptions. */
class BoundsLawTest {
    /** A boat that walks over a random field and takes readings at random times. */
    private class Survey(random: Random, val clear: Boolean = true) {
        val grid = Grid.unit(random.nextInt(1, 6), random.nextInt(1, 6))
        val prior = Interval(random.between(-20.0, 0.0), random.between(0.1, 30.0))
        val truths = DoubleArray(grid.size) { random.between(prior.lower, prior.upper) }
        val field = CellField(grid, truths)

        // From much faster than the sampling to much slower than the whole survey.
        val stage = if (random.nextInt(4) > 0) {
            SensorStage.Lag(10.0.pow(random.between(-2.0, 3.0)))
        } else {
            SensorStage.Slew(10.0.pow(random.between(-3.0, 2.0)))
        }
        val settings = BoundedFilterSettings(
            epsilon = if (random.nextBoolean()) 0.0 else 10.0.pow(random.between(-8.0, -1.0)),
            medianWindow = 1 + 2 * random.nextInt(4),
            slopeWindow = random.nextInt(2, 9),
            clearOnEntry = clear,
            crossing = CrossingPolicy.entries.random(random),
        )
        val start = if (random.nextBoolean()) 1.6e9 else 0.0
        val stays = List(random.nextInt(1, 40)) { random.nextInt(grid.size) to random.nextInt(1, 30) }
        val times = random.nextInt()

        override fun toString() = "$grid, $prior, truths ${truths.toList()}, $stage, $settings, start $start, " +
            "stays $stays, times $times"

        /** Runs the survey and calls [each] after every reading. */
        fun run(filter: BoundedFilter, each: (cell: Int) -> Unit) {
            val random = Random(times)
            val sensor = SensorSpec("", listOf(stage)).build(prior.midpoint, random)
            var time = start
            for ((cell, count) in stays) {
                repeat(count) {
                    // Bursts, equal stamps and long gaps.
                    val next = time + if (random.nextInt(5) == 0) 0.0 else 10.0.pow(random.between(-3.0, 1.5))
                    val truth = field.truth(grid.centerX(cell), grid.centerY(cell), BoatTime(next))
                    val value = sensor.step(truth, next - time, Conditions.NONE)
                    time = next
                    filter.update(BoatTime(time), grid.centerX(cell), grid.centerY(cell), value)
                    each(cell)
                }
            }
        }
    }

    @Test
    fun boundsContainTheTruth() {
        var tightened = 0
        forEvery(cases = 2000, ::Survey) { survey ->
            val filter = BoundedFilter(survey.grid, survey.prior, survey.settings)
            // No tolerance: the bounds are the sensor's own outputs, and it never passes the truth.
            survey.run(filter) { cell ->
                val map = filter.map
                val truth = survey.truths[cell]
                assertTrue(
                    truth in map.lower(cell)..map.upper(cell),
                    "$truth in ${map.lower(cell)}..${map.upper(cell)}",
                )
                assertEquals(0, map.conflicts(cell))
            }
            val map = filter.map
            tightened += (0 until survey.grid.size).count {
                map.lower(it) > survey.prior.lower || map.upper(it) < survey.prior.upper
            }
        }
        // The surveys are such that the law says something.
        assertTrue(tightened > 2000, "$tightened cells with evidence")
    }

    @Test
    fun withoutClearingTheWindowsTheyOftenDoNot() {
        // The same surveys: clearing is what the promise rests on, and the law above can fail.
        var wrong = 0
        forEvery(cases = 300, { Survey(it, clear = false) }) { survey ->
            val filter = BoundedFilter(survey.grid, survey.prior, survey.settings)
            survey.run(filter) { cell ->
                if (survey.truths[cell] !in filter.map.lower(cell)..filter.map.upper(cell)) wrong++
            }
        }
        assertTrue(wrong > 100, "$wrong")
    }

    @Test
    fun aSensorThatDropsOutBetweenTwoVisitsDoesNotBreakTheBounds() {
        // Cell 0 is low and cell 1 high. The sensor rises in 1, where it says nothing, and falls in 0 on its return.
        val field = doubleArrayOf(0.2, 0.9)
        val grid = Grid.unit(2, 1)
        val filter = BoundedFilter(grid, Interval.UNIT, BoundedFilterSettings(1e-6, medianWindow = 3, slopeWindow = 4))
        val sensor = SensorSpec("", listOf(SensorStage.Lag(10.0))).build(0.1, Random(1))
        var time = 0.0
        for ((cell, count) in listOf(0 to 4, 1 to 10, 0 to 4, 1 to 10, 0 to 20)) {
            repeat(count) {
                time++
                val value = sensor.step(field[cell], 1.0, Conditions.NONE)
                filter.update(BoatTime(time), cell + 0.5, 0.5, if (cell == 1) Double.NaN else value)
            }
        }
        assertTrue(0.2 in filter.map.lower(0)..filter.map.upper(0), "${filter.map.lower(0)}..${filter.map.upper(0)}")
        assertEquals(0, filter.map.conflicts(0))
        assertEquals(3, filter.map.visits(0))
    }

    @Test
    fun plainBoundsOnlyTightenWhateverTheReadings() {
        var crossed = 0
        forEvery(cases = 300, { it.nextInt() }) { seed ->
            val random = Random(seed)
            val settings = BoundedFilterSettings(0.0, medianWindow = 1, slopeWindow = 2, random.nextBoolean())
            val filter = BoundedFilter(Grid.unit(2, 1), Interval.UNIT, settings)
            var before = content(filter.map)
            repeat(100) {
                filter.update(BoatTime(it * 0.1), random.nextInt(2) + 0.5, 0.5, random.hostile(-0.5, 1.5))
                val after = content(filter.map)
                for ((old, new) in before.zip(after)) {
                    assertTrue(new.lower >= old.lower && new.upper <= old.upper, "$old to $new, seed $seed")
                    // A conflict is counted exactly when a moved bound lies beyond the other.
                    val moved = new.lower != old.lower || new.upper != old.upper
                    assertEquals(moved && new.lower > new.upper, new.conflicts > old.conflicts, "$old to $new")
                    if (new.lower > new.upper) crossed++
                }
                before = after
            }
        }
        assertTrue(crossed > 100, "$crossed")
    }

    @Test
    fun softBoundsNeverCrossAndResetOnesNeither() {
        for (policy in listOf(CrossingPolicy.SOFT, CrossingPolicy.RESET)) {
            var conflicts = 0
            forEvery(cases = 300, { it.nextInt() }) { seed ->
                val random = Random(seed)
                val settings = BoundedFilterSettings(0.0, 1, 2, clearOnEntry = true, crossing = policy)
                val filter = BoundedFilter(Grid.unit(1, 1), Interval.UNIT, settings)
                repeat(100) {
                    filter.update(BoatTime(it * 0.1), 0.5, 0.5, random.between(-0.5, 1.5))
                    val cell = content(filter.map).single()
                    assertTrue(cell.lower <= cell.upper, "$policy: $cell, seed $seed")
                    assertTrue(cell.value in cell.lower..cell.upper, "$policy: $cell, seed $seed")
                }
                conflicts += filter.map.conflicts(0)
            }
            assertTrue(conflicts > 100, "$conflicts")
        }
    }
}
