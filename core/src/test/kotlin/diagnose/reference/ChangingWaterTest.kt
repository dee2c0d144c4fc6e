package stillwater.diagnose.reference

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.track.SlopeAcross
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What a track says of the water's own change where it goes over an old leg again, a little beside it. */
class ChangingWaterTest {
    /** Water that is alike in all directions: waves of all directions whose slopes reach some [length] m. */
    private class Water(private val length: Double, private val random: java.util.Random) {
        private val waves = List(WAVES) {
            doubleArrayOf(random.nextGaussian() / length, random.nextGaussian() / length, 2 * PI * random.nextDouble())
        }

        /** Of a variance of 1, in sensor units. */
        fun at(x: Double, y: Double) = sqrt(2.0 / WAVES) * waves.sumOf { (east, north, phase) ->
            cos(east * x + north * y + phase)
        }
    }

    /**
     * Half a metre a second around a rectangle of 140 m and 60 m, then 40 m of its first side again, [beside] m from
     * it, in water that rises by [rise] sensor units a second.
     */
    private fun legAgain(seed: Long, rise: Double, beside: Double = 0.2): ChangingWater {
        val random = java.util.Random(seed)
        val water = Water(15.0, random)
        val corners = listOf(0.0 to 0.0, 140.0 to 0.0, 140.0 to 60.0, 0.0 to 60.0, 0.0 to beside, 40.0 to beside)
        val places = ArrayList<Pair<Double, Double>>()
        for ((from, to) in corners.zipWithNext()) {
            val rows = (2 * (to.first - from.first + to.second - from.second)).let { if (it < 0) -it else it }.toInt()
            for (i in 0 until rows) {
                val share = i.toDouble() / rows
                places += from.first + share * (to.first - from.first) to
                    from.second + share * (to.second - from.second)
            }
        }
        val times = DoubleArray(places.size) { it.toDouble() }
        val truth = DoubleArray(places.size) {
            water.at(places[it].first, places[it].second) + rise * times[it] + 0.001 * random.nextGaussian()
        }
        val x = DoubleArray(places.size) { places[it].first + 0.01 * random.nextGaussian() }
        val y = DoubleArray(places.size) { places[it].second + 0.01 * random.nextGaussian() }
        return ChangingWater(MeasuredSeries(times, x, y, truth, truth), truth)
    }

    @Test
    fun aLegGoneOverAgainBesideTheOldOneIsNoChangeOfTheWater() {
        val seeds = FIRST_SEED until FIRST_SEED + LOGS
        val chances = seeds.map { legAgain(it, 0.0).pValue }
        println("legs again, seeds $seeds, p ${chances.map { "%.2g".format(it) }}")
        // Two of forty are expected at one in twenty; more than six come once in two hundred times.
        assertTrue(chances.count { it < 0.05 } <= 6, "$chances")
        assertTrue(chances.all { it > 0.05 / LOGS / 20 }, "$chances")
    }

    @Test
    fun aChangeShowsOnALegGoneOverAgain() {
        val seeds = FIRST_SEED until FIRST_SEED + LOGS
        // A fifth of the water's own spread in the time of the way round, 800 s.
        val rise = 0.2 / 800
        val found = seeds.map { legAgain(it, rise) }
        println("changed water, seeds $seeds, p ${found.map { "%.2g".format(it.pValue) }}")
        assertTrue(found.count { it.pValue < 0.002 } >= LOGS * 9 / 10, "${found.map { it.pValue }}")
        found.forEach { assertEquals(rise, it.rate, 4 * it.error) }
    }

    @Test
    fun slopesAcrossTheWayGoTogetherAsFarAsTheWaterSays() {
        val random = java.util.Random(FIRST_SEED)
        println("slopes across, seed $FIRST_SEED")
        val length = 12.0
        val water = Water(length, random)
        val truth = DoubleArray(8000) { water.at(0.5 * it, 0.3 * it) + 0.0005 * random.nextGaussian() }
        val slope = SlopeAcross(truth, sqrt(0.34))
        for (distance in listOf(3.0, 6.0, 12.0, 20.0)) {
            val there = exp(-distance * distance / (2 * length * length)) / (length * length)
            assertEquals(there, slope.alike(distance), 0.15 / (length * length), "$distance m apart")
        }
        assertEquals(0.0, slope.alike(80.0), 0.05 / (length * length))
    }

    /** A walk of 1 m/s whose heading wanders, with fixes that jitter by 0.3 m, in water that rises by [rise] in all. */
    private fun walk(seed: Long, rise: Double): ChangingWater {
        val random = java.util.Random(seed)
        val water = Water(20.0, random)
        val size = 800
        val x = DoubleArray(size)
        val y = DoubleArray(size)
        var heading = 2 * PI * random.nextDouble()
        var turning = 0.0
        for (i in 1 until size) {
            turning += -turning / 8 + 0.03 * random.nextGaussian()
            heading += turning
            x[i] = x[i - 1] + cos(heading)
            y[i] = y[i - 1] + sin(heading)
        }
        val truth = DoubleArray(size) { water.at(x[it], y[it]) + rise * it / size + 0.002 * random.nextGaussian() }
        for (i in 0 until size) {
            x[i] += 0.3 * random.nextGaussian()
            y[i] += 0.3 * random.nextGaussian()
        }
        return ChangingWater(MeasuredSeries(DoubleArray(size) { it.toDouble() }, x, y, truth, truth), truth)
    }

    /** Errors are then reckoned from jitter and slope alone; that there are so few says nothing of the change. */
    @Test
    fun threeToFivePlacesMetAgainTellOfAChangeAndOfNoneThatIsNotThere() {
        val walks = (FIRST_SEED until FIRST_SEED + WALKS).associateWith { walk(it, 0.0) }
            .filterValues { !it.rate.isNaN() && it.revisits().later.size in 3..5 }
        val seeds = walks.keys.toList()
        val still = walks.values.map { it.pValue }
        val changed = seeds.map { walk(it, 1.0).pValue }
        println("walks that meet few old places, seeds $seeds: p ${still.map { "%.2g".format(it) }}")
        println("the same in water that rises by a deviation: p ${changed.map { "%.2g".format(it) }}")
        assertTrue(seeds.size >= 40, "${seeds.size} walks")
        // At a level of 1 % as many as 5 % come once in a thousand times.
        assertTrue(still.count { it < 0.01 } <= seeds.size / 20, "$still")
        assertTrue(changed.count { it < 5e-4 } > seeds.size / 2, "$changed")
    }

    private companion object {
        const val WALKS = 250
        const val WAVES = 200
        const val FIRST_SEED = 20261125L
        const val LOGS = 40
    }
}
