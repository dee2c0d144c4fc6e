package stillwater.correct

import stillwater.estimate.TrackSeries
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertNull

class StillBoatTest {
    private val random = Random(11)

    private fun why(hasFixes: Boolean, place: (Int) -> Pair<Double, Double>): String? {
        val places = List(600, place)
        val xs = DoubleArray(600) { places[it].first }
        val ys = DoubleArray(600) { places[it].second }
        return StillBoat.why(TrackSeries(DoubleArray(600) { 20.0 * it }, xs, ys, DoubleArray(600)), hasFixes)
    }

    private fun fix() = random.nextDouble(-0.5, 0.5)

    @Test
    fun positionsThatScatterAboutABuoyAreAStillBoat() {
        assertContains(why(hasFixes = false) { 3 * fix() to 3 * fix() }.orEmpty(), "no farther in 50 rows")
    }

    @Test
    fun aTransectToAndFroWithFewRowsIsSailed() {
        for (step in listOf(20, 40)) assertNull(why(hasFixes = true) { abs(it * step % 120 - 60) + fix() to fix() })
    }

    @Test
    fun stationsInRandomOrderAreSailedTo() {
        assertNull(why(hasFixes = false) { random.nextDouble(100.0) to random.nextDouble(100.0) })
    }

    /** Evenly over a disc 95 % of the places lie within 0.97 of its radius. */
    @Test
    fun fixesWithinFiveMetresAreAStillBoatAndSomewhatFartherTheyAreNot() {
        // So slowly round that 50 rows come farther than one.
        fun spiral(radius: Double) = { i: Int ->
            val angle = 0.02 * i
            val r = radius * sqrt((i * 7 % 600) / 600.0 * 0.1 + 0.9)
            r * cos(angle) to r * sin(angle)
        }
        assertContains(why(hasFixes = true, spiral(4.5)).orEmpty(), "lie within 5 m")
        assertNull(why(hasFixes = true, spiral(8.0)))
        assertNull(why(hasFixes = false, spiral(4.5)))
    }

    /** Ten rows a second at 0.5 m/s: 50 rows are 2.5 m, fixes scatter by as much from row to row. */
    @Test
    fun aSlowBoatWithManyRowsIsSailedAndOneThatSwingsAtItsAnchorIsNot() {
        fun why(place: (Double) -> Pair<Double, Double>): String? {
            val noise = java.util.Random(5)
            val places = List(12_000) { i ->
                val (x, y) = place(i / 10.0)
                x + 1.5 * noise.nextGaussian() to y + 1.5 * noise.nextGaussian()
            }
            val times = DoubleArray(places.size) { it / 10.0 }
            val xs = DoubleArray(places.size) { places[it].first }
            val ys = DoubleArray(places.size) { places[it].second }
            return StillBoat.why(TrackSeries(times, xs, ys, DoubleArray(places.size)), hasFixes = false)
        }
        assertNull(why { time -> abs(time % 160 / 2 - 40) to time / 30 })
        for (radius in listOf(0.0, 6.0, 10.0)) {
            val swinging = why { radius * sin(it / 60) to radius * cos(it / 60) }
            assertContains(swinging.orEmpty(), "no farther in 50 rows")
        }
    }
}
