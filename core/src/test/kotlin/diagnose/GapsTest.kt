package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.diagnose.evidence.JumpPlaces
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.UnknownTruth
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** While nothing was logged the boat went on: nobody knows what the sensor saw. */
class GapsTest {
    private fun without(n: Int, vararg gaps: IntRange) = (0 until n).filter { i -> gaps.none { i in it } }

    private fun DoubleArray.at(rows: List<Int>) = DoubleArray(rows.size) { this[rows[it]] }

    /** What is left of what a lag saw in a gap is the water's, or a jump, for who takes it to have settled, or guesses. */
    @Test
    fun aLogWithGapsShowsTheLagAndNothingElse() = listOf(1L, 2L).forEach(::assertLagAlone)

    @Test
    @Tag("long")
    fun soDoOthers() = listOf(3L, 4L).forEach(::assertLagAlone)

    /** Two of the gaps are short where [seed] is even. */
    private fun assertLagAlone(seed: Long) {
        val n = 1000
        val track = CrossingTrack(n)
        val random = java.util.Random(seed)
        val waves = List(8) { DoubleArray(3) { random.nextDouble() } }

        fun water(x: Double, y: Double) = waves.sumOf { (length, way, phase) ->
            val along = x * cos(2 * PI * way) + y * sin(2 * PI * way)
            sin((0.15 + 0.5 * length) * along + 2 * PI * phase)
        }
        val values = track.shown(12.0, water = ::water)
        for (i in 0 until n) values[i] += 0.01 * random.nextGaussian()
        val rows = if (seed % 2 == 0L) {
            without(n, 250 until 275, 600 until 625, 777 until 850)
        } else {
            without(n, 250 until 330, 600 until 665, 777 until 850)
        }
        val log = MeasuredSeries(track.times.at(rows), track.x.at(rows), track.y.at(rows), values.at(rows), null)
        val result = Diagnosis(log).run()
        assertEquals(Verdict.Consistent, result.verdict, "seed $seed")
        val lag = result.baseline.parameters.first()
        assertEquals(12.0, lag.value, 0.1, "seed $seed")
        val interval = assertNotNull(lag.interval)
        assertTrue(12.0 in interval.lower..interval.upper && interval.width < 0.5, "$lag, seed $seed")
        assertTrue(result.warnings.any { "after 3 gaps" in it }, "${result.warnings}")
    }

    /** What is left of a gap may come out late, as once readings leave the end of their range, and rises like a jump. */
    @Test
    fun noJumpIsLookedForWhileTheSensorSettlesAfterAGap() {
        val n = 400
        val times = DoubleArray(n) { it + if (it >= 200) 30.0 else 0.0 }
        val truth = DoubleArray(n) { sin(times[it] / 20) }
        val series = MeasuredSeries(times, DoubleArray(n), DoubleArray(n), truth, truth)
        val scales = Scales(series, UnknownTruth.of(series))
        val model = ResponseModel(series, emptyList(), Steps.EVEN, scales)
        val numbers = doubleArrayOf(10.0, 1.0, 0.0, truth[0])
        val noise = scales.white(BooleanArray(n) { true })
        val fit = Fitting.at(model, numbers, BooleanArray(numbers.size), noise)

        /** The place of a jump by 1 at [row] of what is left. */
        fun found(row: Int) = JumpPlaces(fit, 60, DoubleArray(n) { if (it >= row) 1.0 else 0.0 }).single()
        assertEquals(times[120] - 0.5, found(120))
        assertEquals(times[260] - 0.5, found(260))
        // At the gap itself, and 49 rows on; five time constants are 50 s.
        assertEquals((times[199] + times[200]) / 2, found(200))
        val place = assertNotNull(found(225))
        assertTrue(place < times[200] || place > times[200] + 49, "$place")
    }

    @Test
    @Tag("long")
    fun anEndOfTheRangeIsNamedAcrossGaps() {
        val n = 2000
        val truth = DoubleArray(n) { 8 + 1.2 * sin(it / 23.0) + cos(it / 61.0) + 0.5 * sin(it / 9.0) }
        for (seed in 1L..8L) {
            val stages = listOf(SensorStage.Lag(12.0), SensorStage.Range(upper = 9.3), SensorStage.Noise(0.01))
            val sensor = SensorSpec("hidden", stages).build(truth[0], Random(seed))
            val values = DoubleArray(n) { sensor.step(truth[it], 0.5, Conditions.NONE) }
            val places = java.util.Random(seed)
            val rows = without(n, *Array(3) { (500 * it + 300 + places.nextInt(200)).let { at -> at until at + 60 } })
            val times = DoubleArray(n) { 0.5 * it }.at(rows)
            val still = DoubleArray(rows.size)
            val log = MeasuredSeries(times, still, still, values.at(rows), truth.at(rows))
            val named = assertIs<Verdict.Named>(Diagnosis(log).run().verdict, "seed $seed").causes
            assertTrue(Cause.SATURATION in named && Cause.OFFSET_STEPS !in named, "$named, seed $seed")
        }
    }

    @Test
    fun aLogWithoutGapsLeavesNothingOpen() {
        val times = DoubleArray(300) { it + if (it > 100) 3.5 else 0.0 }
        val log = MeasuredSeries(times, times, times, times, null)
        // A step of four and a half rows and one row is a gap; of three and a half it is not one.
        assertEquals(101, UnknownTruth.ofGaps(log)?.isGap?.indexOf(true))
        val shorter = DoubleArray(300) { it + if (it > 100) 2.5 else 0.0 }
        assertNull(UnknownTruth.ofGaps(MeasuredSeries(shorter, shorter, shorter, shorter, null)))
    }
}
