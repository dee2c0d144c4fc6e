package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.blind.onArm
import stillwater.model.Conditions
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Where the boat was, from fixes that jitter by half a metre. */
class SmoothTrackTest {
    private val n = 600
    private val times = DoubleArray(n) { it.toDouble() }
    private val course = DoubleArray(n) { 0.4 * sin(it / 15.0) + it / 80.0 }
    private val speed = DoubleArray(n) { 1 + 0.3 * sin(it / 40.0) }

    @Test
    fun speedAndHeadingSmoothWhatFixesAlone() {
        val reckoned = error(headed = { course[it] })
        assertTrue(reckoned < 0.6 * error(headed = null), "$reckoned, seed $SEED")
    }

    @Test
    fun aCompassAndACurrentAreToldByTheFixes() {
        // Clockwise from north, and 0.2 m/s of current to the east.
        val reckoned = error(headed = { PI / 2 - course[it] }, current = 0.2)
        assertTrue(reckoned < 0.6 * error(headed = null, current = 0.2), "$reckoned, seed $SEED")
    }

    @Test
    fun headingsThatAreWrongAreNotUsed() {
        val random = Random(SEED + 1)
        val wrong = DoubleArray(n) { random.nextDouble(2 * PI) }
        assertTrue(error(headed = { wrong[it] }) < 1.05 * error(headed = null), "seed $SEED")
    }

    @Test
    fun whatTheBoatDidOverGapsSaysNothingOfItsCompass() {
        // Four rests of ten minutes, over each of which the boat is carried off.
        val reckoned = error(headed = { course[it] }, rests = 4)
        assertTrue(reckoned < 0.6 * error(headed = null, rests = 4), "$reckoned, seed $SEED")
    }

    /** Of fixes every third row the smoothing is told by these alone: rows that repeat one would foretell each other. */
    @Test
    fun fixesThatAreHeldAreSmoothedAsWellAsThoseOfEveryRow() {
        for (headed in listOf<((Int) -> Double)?>(null, { course[it] })) {
            val held = error(headed, held = 3)
            // A third of the fixes: at the best √3 times the error.
            assertTrue(held < 2 * error(headed), "$held against ${error(headed)}, seed $SEED")
        }
    }

    /** The boat rests at one place for ten rows, and has a fix every second row elsewhere. */
    @Test
    fun repeatedFixesSayNothingUnlessTheBoatRests() {
        val x = DoubleArray(30) { if (it in 10 until 20) 5.0 else (it / 2).toDouble() }
        val series = MeasuredSeries(DoubleArray(30) { it.toDouble() }, x, DoubleArray(30), DoubleArray(30), null)
        val known = RepeatedFixes.known(series)
        val fresh = List(15) { 2 * it }.filter { it !in 12 until 20 }
        assertEquals((fresh + (16 until 20)).sorted(), known.indices.filter { known[it] })
    }

    /** On a circle the end of an arm goes on another one, and back where the boat was when the arm is taken off. */
    @Test
    fun theEndOfARigidArmLeavesTheWayInTurns() {
        val x = DoubleArray(n) { 8 * cos(it / 10.0) }
        val y = DoubleArray(n) { 8 * sin(it / 10.0) }
        val boat = SmoothTrack.of(MeasuredSeries(times, x, y, DoubleArray(n), null))
        val probe = boat.onArm(6.0)
        for (i in 1 until n - 1) {
            assertEquals(10.0, hypot(probe.x[i], probe.y[i]), 0.01, "row $i")
            // Behind the boat: the way it came from.
            assertTrue(probe.x[i] * y[i] > probe.y[i] * x[i], "row $i")
        }
        val taken = probe.onArm(0.0)
        assertTrue(taken.x.contentEquals(boat.x) && taken.y.contentEquals(boat.y))
    }

    /** Root mean square of how far the smoothed way is off the true one, m. */
    private fun error(headed: ((Int) -> Double)?, current: Double = 0.0, rests: Int = 0, held: Int = 1): Double {
        val rested = DoubleArray(n) { (it * (rests + 1) / n).toDouble() }
        val x = DoubleArray(n)
        val y = DoubleArray(n)
        for (i in 1 until n) {
            x[i] = x[i - 1] + current + (speed[i - 1] * cos(course[i - 1]) + speed[i] * cos(course[i])) / 2
            y[i] = y[i - 1] + (speed[i - 1] * sin(course[i - 1]) + speed[i] * sin(course[i])) / 2
        }
        for (i in 0 until n) x[i] += CARRIED * rested[i]
        val late = DoubleArray(n) { times[it] + REST * rested[it] }
        val random = java.util.Random(SEED)
        val fixes = listOf(x, y).map { way ->
            val fresh = DoubleArray(n) { way[it] + 0.5 * random.nextGaussian() }
            DoubleArray(n) { fresh[it - it % held] }
        }
        val conditions = if (headed == null) {
            emptyMap()
        } else {
            mapOf(Conditions.SPEED to speed, Conditions.HEADING to DoubleArray(n) { headed(it) })
        }
        val smooth = SmoothTrack.of(MeasuredSeries(late, fixes[0], fixes[1], DoubleArray(n), null, conditions))
        return sqrt((0 until n).sumOf { hypot(smooth.x[it] - x[it], smooth.y[it] - y[it]).let { d -> d * d } } / n)
    }

    private companion object {
        const val SEED = 20261122L

        /** A rest, s, and how far the boat is carried while it rests, m. */
        const val REST = 600.0
        const val CARRIED = 300.0
    }
}
