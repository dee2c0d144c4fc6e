package stillwater.estimate

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.exp
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class IntervalFilterTest {
    /** A boat with a sensor no slower than a limit, whose time constant may depend on the direction and the moment. */
    private class Survey(random: Random) {
        val grid = Grid.unit(random.nextInt(1, 4), random.nextInt(1, 4))
        val prior = Interval(random.between(-20.0, 0.0), random.between(0.1, 30.0))
        val truths = DoubleArray(grid.size) { random.between(prior.lower, prior.upper) }
        val limit = 10.0.pow(random.between(-1.0, 2.5))
        val error = if (random.nextBoolean()) 0.0 else prior.width * 10.0.pow(random.between(-5.0, -1.0))
        val isSteady = random.nextBoolean()
        val rising = limit * share(random)
        val falling = limit * share(random)
        val stays = List(random.nextInt(1, 30)) { random.nextInt(grid.size) to random.nextInt(1, 60) }
        val seed = random.nextInt()

        /** Often the limit itself, where the bounds are tightest. */
        private fun share(random: Random) = if (random.nextInt(3) == 0) 1.0 else random.between(0.01, 1.0)

        override fun toString() = "$grid, $prior, truths ${truths.toList()}, limit $limit, error $error, " +
            "rising $rising, falling $falling, steady $isSteady, stays $stays, seed $seed"

        fun run(filter: IntervalFilter, each: (cell: Int) -> Unit) {
            val random = Random(seed)
            var state = prior.midpoint
            var time = 0.0
            for ((cell, count) in stays) {
                repeat(count) {
                    // Bursts, equal stamps and long gaps.
                    val next = time + if (random.nextInt(8) == 0) 0.0 else limit * 10.0.pow(random.between(-2.0, 0.5))
                    // What passes by the stamps.
                    val step = next - time
                    val most = if (truths[cell] > state) rising else falling
                    val constant = if (isSteady) most else most * random.between(0.2, 1.0)
                    state = truths[cell] + (state - truths[cell]) * exp(-step / constant)
                    time = next
                    val reading = state + error * random.between(-1.0, 1.0)
                    filter.update(BoatTime(time), grid.centerX(cell), grid.centerY(cell), reading)
                    each(cell)
                }
            }
        }
    }

    @Test
    fun boundsContainTheTruthWhateverTheResponseUpToTheLimit() {
        var narrow = 0
        forEvery(drawn(::Survey), cases = 1500) { survey ->
            val filter = IntervalFilter(survey.grid, survey.prior, IntervalFilterSettings(survey.limit, survey.error))
            val map = filter.map
            survey.run(filter) { cell ->
                val truth = survey.truths[cell]
                assertTrue(
                    truth in map.lower(cell)..map.upper(cell),
                    "$truth in ${map.lower(cell)}..${map.upper(cell)}",
                )
                assertEquals(0, map.conflicts(cell))
            }
            narrow += (0 until survey.grid.size).count { map.upper(it) - map.lower(it) < survey.prior.width / 10 }
        }
        // The surveys are such that the law says something.
        assertTrue(narrow > 1500, "$narrow cells known to a tenth of the prior")
    }

    @Test
    fun aSensorAtTheLimitIsSolvedExactlyWithoutError() {
        val filter = IntervalFilter(Grid.unit(1, 1), Interval.UNIT, IntervalFilterSettings(10.0))
        for (k in 0..4) filter.update(BoatTime(k.toDouble()), 0.5, 0.5, 0.8 - 0.6 * exp(-k / 10.0))
        // The upper bound is the truth, 0.8; the lower one the last reading. 64 roundings, magnified 10 times.
        assertEquals(0.8, filter.map.upper(0), 1e-12)
        assertEquals(0.8 - 0.6 * exp(-0.4), filter.map.lower(0), 1e-12)
        assertEquals(filter.map.lower(0) / 2 + filter.map.upper(0) / 2, filter.map.value(0))
    }

    @Test
    fun standingStillForLongBoundsBothSides() {
        val filter = IntervalFilter(Grid.unit(1, 1), Interval.UNIT, IntervalFilterSettings(10.0, readingError = 0.01))
        for (k in 0..1000) filter.update(BoatTime(k.toDouble()), 0.5, 0.5, 0.3)
        // Over many time constants c goes to 0: the readings' error is what is left.
        assertEquals(0.31, filter.map.upper(0), 1e-6)
        assertEquals(0.29, filter.map.lower(0), 1e-6)
    }

    @Test
    fun aSingleReadingSaysNothingAndNeitherDoTwoOfTheSameMoment() {
        val filter = IntervalFilter(Grid.unit(2, 1), Interval.UNIT, IntervalFilterSettings(10.0))
        filter.update(BoatTime(1.0), 0.5, 0.5, 0.3)
        filter.update(BoatTime(1.0), 0.5, 0.5, 0.4)
        // Nor does a pair over a border.
        filter.update(BoatTime(2.0), 1.5, 0.5, 0.5)
        for (cell in 0..1) {
            assertEquals(0.0, filter.map.lower(cell))
            assertEquals(1.0, filter.map.upper(cell))
        }
    }

    @Test
    fun aSensorSlowerThanTheLimitShowsAsAConflict() {
        val filter = IntervalFilter(Grid.unit(1, 1), Interval.UNIT, IntervalFilterSettings(1.0))
        for (k in 0..40) filter.update(BoatTime(k.toDouble()), 0.5, 0.5, 0.9 - 0.8 * exp(-k / 30.0))
        assertTrue(filter.map.conflicts(0) > 0)
        assertTrue(filter.map.lower(0) <= filter.map.upper(0))
    }

    @Test
    fun refusesImpossibleSettings() {
        assertThrows<IllegalArgumentException> { IntervalFilterSettings(0.0) }
        assertThrows<IllegalArgumentException> { IntervalFilterSettings(Double.NaN) }
        assertThrows<IllegalArgumentException> { IntervalFilterSettings(1.0, -1e-9) }
        assertThrows<IllegalArgumentException> { IntervalFilterSettings(1.0, Double.POSITIVE_INFINITY) }
    }
}
