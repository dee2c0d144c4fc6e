package stillwater.survey

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** A known lawnmower survey through a known sensor: the comparison must find what was put in. */
class LegComparisonTest {
    private fun survey(legs: Int, lag: Double, noise: Double = 0.0, turn: Double = 0.0): SurveyScan {
        val scan = SurveyScan()
        val random = Random(SEED)
        var reading = Double.NaN
        var seconds = 0.0
        for (leg in 0 until legs) {
            // 200 m along, then 10 m across, 1 m/s, 1 Hz.
            for (step in 0 until 210) {
                val along = minOf(step, 200).toDouble()
                val x = leg * 10.0 + maxOf(0, step - 200)
                val y = if (leg % 2 == 0) along else 200 - along
                val truth = sin(2 * PI * y / 150) + 0.3 * cos(2 * PI * x / 200)
                reading = if (reading.isNaN()) truth else reading + (1 - exp(-1 / lag)) * (truth - reading)
                val shown = reading + noise * random.nextDouble(-1.0, 1.0)
                val east = x * cos(turn) - y * sin(turn)
                val north = x * sin(turn) + y * cos(turn)
                scan.take(BoatTime(seconds), east, north, shown, Conditions.NONE)
                seconds += 1.0
            }
        }
        return scan
    }

    private fun compare(scan: SurveyScan): LegMismatch? {
        val statistics = scan.statistics()
        val track = scan.track()
        return LegComparison(statistics, track).compare(LegFinder(statistics).find(track))
    }

    @Test
    fun findsTheLagOfAFirstOrderSensor() {
        for (lag in listOf(4.0, 10.0, 20.0)) {
            val mismatch = assertNotNull(compare(survey(legs = 14, lag = lag, noise = 0.01)))
            assertEquals(14, mismatch.legs.legs.size)
            assertEquals(12, mismatch.scores.size)
            assertTrue(mismatch.shift.isClear)
            // A lag of tau delays a wave of angular frequency w by atan(w tau) / w, here by 1 to 14 % less than tau.
            val delay = kotlin.math.atan(2 * PI / 150 * lag) / (2 * PI / 150)
            // After a turn the sensor meets the water it has just left, so that the first metres of a leg show less lag.
            assertEquals(delay, mismatch.shift.seconds, 0.5 + 0.15 * delay, "seed $SEED, lag $lag s")
            val step = mismatch.shift.shifts[1] - mismatch.shift.shifts[0]
            assertTrue(mismatch.shift.high - mismatch.shift.low >= step, "seed $SEED, lag $lag s, grid $step s")
            assertTrue(mismatch.shift.mismatch < mismatch.opposite.mean / 3)
            assertTrue(assertNotNull(mismatch.excess).mean > 0)
            assertEquals(LegVerdict.LAG_SEEN, mismatch.verdict, "seed $SEED, lag $lag s")
            assertFalse(mismatch.hasReserve)
        }
    }

    @Test
    fun findsItHoweverTheSurveyLies() {
        for (turn in listOf(0.3, 1.2, 2.5, -1.0)) {
            val mismatch = assertNotNull(compare(survey(legs = 12, lag = 10.0, turn = turn)))
            assertEquals(9.0, mismatch.shift.seconds, 1.5, "turned by $turn")
        }
    }

    /** A boat at 1 m/s up and down a line of 200 m, back [aside] m beside it, over water of many lengths. */
    private fun upAndDown(aside: Double, lag: Double): SurveyScan {
        val scan = SurveyScan()
        val random = Random(SEED)
        var reading = Double.NaN
        for (second in 0 until 14 * 200) {
            val along = (second % 200).toDouble()
            val isBack = second / 200 % 2 == 1
            val x = if (isBack) 200 - along else along
            val y = (if (isBack) aside else 0.0) + 0.2 * random.nextDouble(-1.0, 1.0)
            val truth = sin(x / 24 + 0.3) * cos(y / 27) + 0.5 * sin(x / 13 + y / 11)
            reading = if (reading.isNaN()) truth else reading + (1 - exp(-1 / lag)) * (truth - reading)
            scan.take(BoatTime(second.toDouble()), x, y, reading + 0.01 * random.nextDouble(-1.0, 1.0), Conditions.NONE)
        }
        return scan
    }

    @Test
    fun legsBackBesideThoseOutAreNoLag() {
        for (aside in listOf(4.0, 30.0)) {
            val mismatch = assertNotNull(compare(upAndDown(aside, lag = 1e-3)))
            assertEquals(aside, assertNotNull(mismatch.aside).distance, 0.3, "seed $SEED")
            assertEquals(LegVerdict.ASIDE, mismatch.verdict, "$aside m, seed $SEED")
            assertTrue(mismatch.isAside)
        }
        for (aside in listOf(0.0, 2.0)) {
            val mismatch = assertNotNull(compare(upAndDown(aside, lag = 12.0)))
            assertEquals(LegVerdict.LAG_SEEN, mismatch.verdict, "$aside m, seed $SEED")
            assertFalse(mismatch.isAside)
        }
    }

    @Test
    fun seesNoLagWhereThereIsNone() {
        val mismatch = assertNotNull(compare(survey(legs = 14, lag = 1e-3, noise = 0.05)))
        assertEquals(0.0, mismatch.shift.seconds, 1.0, "seed $SEED")
        assertFalse(mismatch.shift.isClear)
        assertTrue(assertNotNull(mismatch.excess).run { mean < 2 * standardError })
        assertEquals(LegVerdict.NOT_TOLD_APART, mismatch.verdict)
    }

    @Test
    fun doesNotTellALagFromFewLegs() {
        val mismatch = assertNotNull(compare(survey(legs = 8, lag = 10.0)))
        assertFalse(mismatch.shift.isClear, "6 legs with two neighbours each are too few")
    }

    /** In blocks of three, each sample of three legs has the same ones. */
    @Test
    fun threeLegsHaveNoStandardError() {
        assertTrue(assertNotNull(compare(survey(legs = 5, lag = 10.0))).opposite.standardError.isNaN())
        assertTrue(assertNotNull(compare(survey(legs = 6, lag = 10.0))).opposite.standardError.isFinite())
    }

    @Test
    fun seesALagOnlyAboveTwoStandardErrorsAndFromEnoughLegs() {
        assertEquals(LegVerdict.LAG_SEEN, LegVerdict.of(Estimate(0.21, 0.1), legs = 8))
        assertEquals(LegVerdict.NOT_TOLD_APART, LegVerdict.of(Estimate(0.19, 0.1), legs = 8))
        assertEquals(LegVerdict.NOT_TOLD_APART, LegVerdict.of(Estimate(-0.5, 0.1), legs = 8))
        assertEquals(LegVerdict.TOO_FEW_LEGS, LegVerdict.of(Estimate(0.21, 0.0), legs = 3))
        assertEquals(LegVerdict.TOO_FEW_LEGS, LegVerdict.of(null, legs = 0))
    }

    @Test
    fun aClearShiftWithoutAnExcessHasAReserve() {
        fun mismatch(excess: Estimate): LegMismatch {
            val scores = List(10) { LegScore(it + 1, opposite = 1.0, same = 1.0) }
            val shifts = doubleArrayOf(-10.0, -5.0, 0.0, 5.0, 10.0)
            val shift = LagShift(3.0, 2.0, 4.0, 0.5, Estimate(0.5, 0.1), 10, 10.0, shifts, DoubleArray(5))
            return LegMismatch(Legs(0.0, emptyList()), scores, 1.0, excess, excess, excess, excess, shift)
        }
        assertTrue(mismatch(Estimate(-0.1, 0.1)).hasReserve)
        assertTrue(mismatch(Estimate(0.1, 0.1)).hasReserve)
        assertFalse(mismatch(Estimate(0.3, 0.1)).hasReserve)
    }

    @Test
    fun saysSoWhereThereIsNothingToCompare() {
        assertNull(compare(survey(legs = 3, lag = 10.0)))
        val still = SurveyScan()
        for (i in 0 until 100) still.take(BoatTime(i.toDouble()), 0.0, 0.0, 1.0, Conditions.NONE)
        assertNull(compare(still))
    }

    private companion object {
        const val SEED = 3
    }
}
