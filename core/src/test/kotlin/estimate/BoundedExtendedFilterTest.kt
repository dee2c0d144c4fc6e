package stillwater.estimate

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class BoundedExtendedFilterTest {
    private val direction = BoundedExtendedSettings(learnsResponse = false)

    /** A boat with a sensor that moves towards the truth at any speed and never passes it; every so often it lies. */
    private class Survey(random: Random) {
        val grid = Grid.unit(random.nextInt(1, 4), random.nextInt(1, 4))
        val prior = Interval(random.between(-20.0, 0.0), random.between(0.1, 30.0))
        val truths = DoubleArray(grid.size) { random.between(prior.lower, prior.upper) }
        val rising = 10.0.pow(random.between(-1.0, 2.0))
        val falling = 10.0.pow(random.between(-1.0, 2.0))
        val lies = random.nextBoolean()
        val stays = List(random.nextInt(1, 40)) { random.nextInt(grid.size) to random.nextInt(1, 40) }
        val seed = random.nextInt()

        override fun toString() =
            "$grid, $prior, truths ${truths.toList()}, rising $rising, falling $falling, lies $lies, stays $stays, $seed"

        fun run(filter: BoundedExtendedFilter, each: (cell: Int) -> Unit) {
            val random = Random(seed)
            var state = prior.midpoint
            var time = 0.0
            var sinceLie = 0
            for ((cell, count) in stays) {
                repeat(count) {
                    val step = if (random.nextInt(4) == 0) random.between(0.0, 3.0) else 1.0
                    time += step
                    val constant = if (truths[cell] > state) rising else falling
                    state = truths[cell] + (state - truths[cell]) * exp(-step / constant)
                    val lie = lies && sinceLie >= 3 && random.nextInt(5) == 0
                    sinceLie = if (lie) 0 else sinceLie + 1
                    val value = if (lie) random.between(-1e3, 1e3) else state
                    filter.update(BoatTime(time), grid.centerX(cell), grid.centerY(cell), value)
                    each(cell)
                }
            }
        }
    }

    @Test
    fun directionsBoundTheTruthWhateverOneReadingInFourSays() {
        var tightened = 0
        forEvery(drawn(::Survey), cases = 600) { survey ->
            val filter = BoundedExtendedFilter(survey.grid, survey.prior, direction)
            val map = filter.map
            survey.run(filter) { cell ->
                val truth = survey.truths[cell]
                // A state that has come to the truth is rounded there.
                val rounding = 1e-14 * survey.prior.width
                assertTrue(
                    truth in map.lower(cell) - rounding..map.upper(cell) + rounding,
                    "$truth in ${map.lower(cell)}..${map.upper(cell)}",
                )
            }
            tightened += (0 until survey.grid.size).count {
                map.lower(it) > survey.prior.lower || map.upper(it) < survey.prior.upper
            }
        }
        assertTrue(tightened > 600, "$tightened cells with evidence")
    }

    /** Readings of [count] a stay over [stays] cells in a row of [truths], through a first-order lag. */
    private fun survey(
        filter: BoundedExtendedFilter,
        truths: DoubleArray,
        stays: Int,
        rising: Double = 9.5,
        falling: Double = 9.5,
        noise: Double = 0.0,
    ) {
        val random = Random(3)
        var state = truths[0]
        var time = 0.0
        var cell = 0
        repeat(stays) {
            repeat(10) {
                time += 1.0
                val constant = if (truths[cell] > state) rising else falling
                state = truths[cell] + (state - truths[cell]) * exp(-1 / constant)
                val error = noise * (random.nextDouble() + random.nextDouble() + random.nextDouble() - 1.5)
                filter.update(BoatTime(time), cell + 0.5, 0.5, state + error)
            }
            val step = if (random.nextBoolean()) 1 else -1
            cell = (cell + step).coerceIn(truths.indices)
            if (it % 7 == 0) cell = random.nextInt(truths.size)
        }
    }

    private fun truths(cells: Int) = Random(5).let { random -> DoubleArray(cells) { random.nextDouble() } }

    @Test
    fun withoutNoiseTheRatiosAreThoseOfTheSensorForEachDirection() {
        val truths = truths(12)
        val filter = BoundedExtendedFilter(Grid.unit(12, 1), Interval.UNIT)
        assertTrue(filter.risingRatio.isNaN() && filter.fallingRatio.isNaN(), "nothing is known before any reading")
        survey(filter, truths, stays = 300, rising = 12.0, falling = 6.0)
        // v is a second behind, the slope that of the chord over medians from 1 to 5 s back, and of the pooled slopes
        // the mean: the ratio of distance to slope, the same in every stay of one direction.
        assertEquals(expectedRatio(12.0), filter.risingRatio, 0.02 * 12, "stays that turn in the cell before blur it")
        assertEquals(expectedRatio(6.0), filter.fallingRatio, 0.02 * 6, "the same")
        for (cell in truths.indices) assertEquals(truths[cell], filter.map.value(cell), 2e-3)
    }

    /** Distance at the newest median over the least-squares slope of five medians, for exp(−t/[constant]). */
    private fun expectedRatio(constant: Double): Double {
        val offsets = listOf(-2.0, -1.0, 0.0, 1.0, 2.0)
        val slope = offsets.sumOf { it * exp(-(it - 2) / constant) } / offsets.sumOf { it * it }
        return -1 / slope
    }

    @Test
    fun aSlopeOfZeroSetsBothBoundsOnceTheResponseIsKnown() {
        val truths = truths(12)
        val filter = BoundedExtendedFilter(Grid.unit(12, 1), Interval.UNIT)
        survey(filter, truths, stays = 200, noise = 0.002)
        val width = filter.map.upper(4) - filter.map.lower(4)
        var time = 1e4
        repeat(60) { filter.update(BoatTime(time++), 4.5, 0.5, truths[4] + 0.001 * (it % 2)) }
        assertTrue(truths[4] in filter.map.lower(4)..filter.map.upper(4))
        assertTrue(filter.map.upper(4) - filter.map.lower(4) < width)
    }

    @Test
    fun oneBoundIsTheValueAndTwoAreWeighedByTheirSlopesBeforeTheResponseIsKnown() {
        val filter = BoundedExtendedFilter(Grid.unit(2, 1), Interval.UNIT, direction)
        for (i in 0 until 20) filter.update(BoatTime(i.toDouble()), 0.5, 0.5, 0.2 + 0.01 * i)
        // Median one reading back; an exact ramp has no noise, but steps of 0.01 that might be the sensor's resolution.
        assertEquals(0.38 - 0.005, filter.map.lower(0), 1e-12, "rounding")
        assertEquals(1.0, filter.map.upper(0))
        assertEquals(filter.map.lower(0), filter.map.value(0))
        filter.update(BoatTime(20.0), 1.5, 0.5, 0.5)
        for (i in 21 until 40) filter.update(BoatTime(i.toDouble()), 0.5, 0.5, 0.9 - 0.02 * (i - 20))
        assertEquals(0.54 + 0.005, filter.map.upper(0), 1e-12, "rounding")
        val (lower, upper) = filter.map.lower(0) to filter.map.upper(0)
        assertEquals(lower + (upper - lower) / 3, filter.map.value(0), 1e-9, "slopes of 0.01 and 0.02")
    }

    @Test
    fun evidenceThatContradictsABoundDropsBothAndIsCounted() {
        val filter = BoundedExtendedFilter(Grid.unit(2, 1), Interval.UNIT, direction)
        for (i in 0 until 20) filter.update(BoatTime(i.toDouble()), 0.5, 0.5, 0.9 - 0.02 * i)
        filter.update(BoatTime(20.0), 1.5, 0.5, 0.7)
        assertTrue(filter.map.upper(0) < 0.6)
        for (i in 21 until 32) filter.update(BoatTime(i.toDouble()), 0.5, 0.5, 0.7 + 0.01 * (i - 20))
        assertEquals(1, filter.map.conflicts(0))
        assertEquals(1.0, filter.map.upper(0))
        assertTrue(filter.map.lower(0) in 0.7..0.81)
    }

    @Test
    fun tooFewReadingsForASlopeGiveTheLastOfThemAndNoBounds() {
        val filter = BoundedExtendedFilter(Grid.unit(1, 1), Interval.UNIT)
        for (i in 0 until 6) filter.update(BoatTime(i.toDouble()), 0.5, 0.5, 0.1 * i)
        assertEquals(listOf(0.5, 0.0, 1.0), listOf(filter.map.value(0), filter.map.lower(0), filter.map.upper(0)))
    }

    @Test
    fun noiseIsFoundWhileTheSensorMoves() {
        val noise = ReadingNoise(smallest = 1e-9)
        val random = java.util.Random(1)
        for (i in 0 until 4000) {
            if (i % 40 == 0) noise.interrupt()
            noise.add(i.toDouble(), exp(-(i % 40) / 9.5) + 0.002 * random.nextGaussian(), rising = i % 2 == 0)
        }
        // 2000 differences each, correlated over four: a standard error of 3 %; and the bend of the response.
        assertEquals(0.002, noise.deviation(true), 0.0002)
        assertEquals(0.002, noise.deviation(false), 0.0002)
    }

    @Test
    fun anOutlierInAHundredReadingsHardlyRaisesTheNoise() {
        val noise = ReadingNoise(smallest = 1e-9)
        val random = java.util.Random(2)
        for (i in 0 until 4000) {
            noise.add(i.toDouble(), (if (i % 100 == 50) 1.0 else 0.0) + 0.002 * random.nextGaussian(), rising = true)
        }
        // Four of a hundred differences, capped at nine times the mean m: m = 0.96 + 0.36 m, 1.5, of which the root.
        assertEquals(0.002 * kotlin.math.sqrt(1.5), noise.deviation(true), 0.0003)
    }

    @Test
    fun theResolutionIsTheSmallestStepAndNoReadingIsBetterThanItsRounding() {
        val noise = ReadingNoise(smallest = 1e-9)
        for (i in 0 until 100) noise.add(i.toDouble(), 0.25 * (i / 10), true)
        assertEquals(0.25, noise.resolution)
        assertTrue(noise.deviation(true) >= 0.25 / kotlin.math.sqrt(12.0) - 1e-15, "a uniform error has this deviation")
        assertTrue(abs(noise.besidesRounding(0.25 / kotlin.math.sqrt(12.0))) < 1e-8, "root of a rounding")
    }

    @Test
    fun settingsSayWhatIsWrongWithThem() {
        assertThrows<IllegalArgumentException> { BoundedExtendedSettings(medianWindow = 2) }
        assertThrows<IllegalArgumentException> { BoundedExtendedSettings(slopeWindow = 1) }
    }
}
