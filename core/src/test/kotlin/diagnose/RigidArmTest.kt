package stillwater.diagnose

import org.junit.jupiter.api.Tag
import java.util.Random
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A probe on a rigid arm: where the boat turns, the probe is not where the boat was or will be. */
class RigidArmTest {
    private val rows = 900

    /** Turns of 7 to 21 m about a middle, at 0.4 to 1.3 m/s. */
    private fun radius(time: Double) = 14 + 7 * sin(1.37 * time / TURN)

    private fun east(time: Double) = radius(time) * cos(time / TURN)

    private fun north(time: Double) = radius(time) * sin(time / TURN)

    private fun water(x: Double, y: Double) = sin(x / 4) + sin(y / 5 + 1) + sin((x + y) / 7)

    /** The water [ahead] m before the boat, along its course. */
    private fun truth(time: Double, ahead: Double): Double {
        val dx = east(time + SHORT) - east(time - SHORT)
        val dy = north(time + SHORT) - north(time - SHORT)
        val way = hypot(dx, dy)
        return water(east(time) + ahead * dx / way, north(time) + ahead * dy / way)
    }

    private fun diagnosed(
        ahead: Double,
        hasReference: Boolean,
        isHeld: Boolean = false,
        noise: Double = if (hasReference) HIDING else NOISE,
    ): DiagnosisResult {
        val random = Random(SEED)
        var state = truth(0.0, ahead)
        val values = DoubleArray(rows) { row ->
            for (k in 0 until if (row > 0) STEPS else 0) {
                val time = if (isHeld) row.toDouble() else row - 1 + (k + 0.5) / STEPS
                state += (1 - exp(-1 / (STEPS * LAG))) * (truth(time, ahead) - state)
            }
            state + noise * random.nextGaussian()
        }
        val times = DoubleArray(rows) { it.toDouble() }
        val x = DoubleArray(rows) { east(times[it]) }
        val y = DoubleArray(rows) { north(times[it]) }
        val reference = if (hasReference) DoubleArray(rows) { truth(times[it], 0.0) } else null
        return Diagnosis(MeasuredSeries(times, x, y, values, reference)).run()
    }

    @Test
    fun aProbeBeforeTheBowIsFoundWhereItIs() = assertFound(ahead = 1.5)

    @Test
    @Tag("long")
    fun aProbeBehindTheSternIsFoundWhereItIs() = assertFound(ahead = -1.5)

    /** A truth that is held over each row is ahead by half a row, too, but in time: where speeds differ that is not the same. */
    @Test
    @Tag("long")
    fun aProbeThatIsAheadByHalfARowsWayIsNoHeldTruth() = assertFound(ahead = 0.45)

    @Test
    fun norIsItBesideAReference() = assertFound(ahead = 0.45, hasReference = true)

    /** Of the water at the end of an arm that swings out, as here always, a reference along the way says nothing. */
    @Test
    fun oneOnALongArmIsFoundBesideAReferenceWhereNoiseHidesNothing() {
        val found = diagnosed(ahead = 1.5, hasReference = true, noise = NOISE)
        assertEquals(Verdict.Named(listOf(Cause.POSITION_OFFSET)), found.verdict, "seed $SEED")
        val numbers = checkNotNull(found.extended).parameters.associate { it.name to it.value }
        assertEquals(-1.5, numbers.getValue("behind_m"), 0.05 * 1.5, "$numbers, seed $SEED")
        assertEquals(LAG, numbers.getValue("time_constant_s"), 0.03 * LAG, "$numbers, seed $SEED")
    }

    @Test
    fun aHeldTruthIsNoProbeAhead() {
        for (hasReference in listOf(false, true)) {
            val found = diagnosed(ahead = 0.0, hasReference, isHeld = true)
            assertEquals(Verdict.Consistent, found.verdict, "seed $SEED")
            val lag = found.baseline.parameters.first { it.name == "time_constant_s" }.value
            assertTrue(abs(lag - LAG) < 0.02 * LAG, "$lag, seed $SEED")
        }
    }

    /** The arm explains what is left of a way along the track alone, which a second cause would be named for. */
    private fun assertFound(ahead: Double, hasReference: Boolean = false) {
        val found = diagnosed(ahead, hasReference)
        assertEquals(Verdict.Named(listOf(Cause.POSITION_OFFSET)), found.verdict, "seed $SEED")
        val numbers = checkNotNull(found.extended).parameters.associate { it.name to it.value }
        assertTrue(abs(numbers.getValue("behind_m") + ahead) < 0.05 * abs(ahead), "$numbers, seed $SEED")
        assertTrue(abs(numbers.getValue("time_constant_s") - LAG) < 0.02 * LAG, "$numbers, seed $SEED")
    }

    private companion object {
        const val SEED = 20261126L
        const val NOISE = 0.004

        /** What hides by how much an arm of half a row's way leaves the way: of the water there a reference says nothing. */
        const val HIDING = 0.02
        const val LAG = 5.0
        const val TURN = 16.0
        const val STEPS = 100
        const val SHORT = 1e-4
    }
}
