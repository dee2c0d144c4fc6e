package stillwater.correct

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.survey.Leg
import stillwater.survey.LegComparison
import stillwater.survey.LegFinder
import stillwater.survey.LegMismatch
import stillwater.survey.SurveyScan
import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

class HeldOutLegsTest {
    /** Legs of 100 m, 10 m apart, at 1 m/s and 1 Hz, through a lag of [lag] s, 0 for none. */
    private fun survey(legs: Int, lag: Double): LegMismatch {
        val scan = SurveyScan()
        var reading = 0.0
        for (row in 0 until legs * ROWS) {
            val leg = row / ROWS
            val step = row % ROWS
            val along = minOf(step, 100).toDouble()
            val y = if (leg % 2 == 0) along else 100 - along
            val truth = sin(2 * PI * y / 70)
            reading = if (lag == 0.0) truth else reading + (1 - exp(-1 / lag)) * (truth - reading)
            scan.take(BoatTime(row.toDouble()), leg * 10.0 + maxOf(0, step - 100), y, reading, Conditions.NONE)
        }
        val statistics = scan.statistics()
        val track = scan.track()
        return assertNotNull(LegComparison(statistics, track).compare(LegFinder(statistics).find(track)))
    }

    @Test
    fun halvesAreScoredOnLegsWhoseNeighboursAreUnseenToo() {
        val measured = survey(legs = 12, lag = 8.0)
        val legs = measured.legs.legs
        val learnedOn = ArrayList<Set<Int>>()
        val scores = HeldOutLegs(CorrectedLegs(measured, DoubleArray(0))) { rows ->
            learnedOn += rows.toSet()
            CorrectedLegs(survey(legs = 12, lag = 0.0), DoubleArray(0))
        }.scores()
        assertEquals(
            listOf("the first half", "the second half", "odd pairs", "even pairs"),
            scores.map {
                it.learnedOn
            },
        )
        // Of six legs a half, those whose neighbours are of the same half.
        assertEquals(listOf(4, 4), scores.take(2).map { it.legs })
        assertTrue(learnedOn[0].max() < legs[6].first && learnedOn[1].min() == legs[6].first)
        assertTrue(learnedOn[2].none { it in learnedOn[3] })
        for (row in listOf(legs[2].first, legs[3].last)) assertTrue(row in learnedOn[3] && row !in learnedOn[2])
        // Without a lag opposite legs are the same but for the bins' edges.
        for (score in scores) assertTrue(score.gain > 0.8, "$score")
    }

    @Test
    fun whatSmoothingAloneTakesIsNoGainOfTheLag() {
        val measured = CorrectedLegs(survey(legs = 12, lag = 8.0), DoubleArray(0))
        val smoothed = CorrectedLegs(survey(legs = 12, lag = 4.0), DoubleArray(0))
        // Where the correction leaves what smoothing leaves, all of the gain is smoothing's.
        for (score in HeldOutLegs(measured, smoothed = smoothed) { smoothed }.scores()) {
            assertTrue(score.gain > 0.2, "$score")
            assertEquals(0.0, score.lagGain, 1e-12)
            assertEquals(score.after, score.smoothed, 1e-12)
        }
        for (score in HeldOutLegs(measured, smoothed = smoothed) { measured }.scores()) {
            assertTrue(score.lagGain < 0, "$score")
        }
    }

    @Test
    fun whatTeachesNothingHasNoScore() {
        val measured = CorrectedLegs(survey(legs = 12, lag = 8.0), DoubleArray(0))
        assertEquals(emptyList(), HeldOutLegs(measured) { null }.scores())
    }

    @Test
    fun fewLegsAreNotSplit() {
        val few = CorrectedLegs(survey(legs = 7, lag = 8.0), DoubleArray(0))
        assertEquals(emptyList(), HeldOutLegs(few) { few }.scores())
    }

    @Test
    fun successivePassesAreComparedBetweenReadingsAndOnlyWhereBothHaveThem() {
        // Down to 10 with readings of the place, up to 4 with readings two higher.
        val places = DoubleArray(18) { if (it < 11) it.toDouble() else 21.0 - it }
        val legs = listOf(leg(0, 10), leg(11, 17))
        val values = DoubleArray(18) { places[it] + if (it < 11) 0.0 else 2.0 }
        assertEquals(2.0, PassDifference(places, legs, 0.0, 10.0).of(values, listOf(0)), 1e-12)
        assertTrue(PassDifference(places, legs, 0.0, 3.0).of(values, listOf(0)).isNaN())
    }

    private fun leg(first: Int, last: Int) =
        Leg(first, last, forward = true, start = 0.0, end = 10.0, across = 0.0, seconds = 10.0)

    private companion object {
        const val ROWS = 110
    }
}
