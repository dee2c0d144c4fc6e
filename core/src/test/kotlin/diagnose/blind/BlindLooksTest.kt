package stillwater.diagnose.blind

import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

class BlindLooksTest {
    private val n = 700
    private val track = CrossingTrack(n)
    private val times = track.times
    private val x = track.x
    private val y = track.y
    private val truth = track.truth
    private val lagged = run {
        val sensor = SensorSpec(
            "hidden",
            listOf(SensorStage.Lag(LAG), SensorStage.Noise(NOISE)),
        ).build(truth[0], Random(3))
        DoubleArray(n) { sensor.step(truth[it], 1.0, Conditions.NONE) }
    }

    private fun log(more: (Int) -> Double) =
        MeasuredSeries(times, x, y, DoubleArray(n) { lagged[it] + more(it) }, null)

    private fun rms(column: DoubleArray) = sqrt(squares(column) / column.size)

    /** The lag's own change, of which some would do as well, is none of it: the lag is fitted beside it. */
    @Test
    fun whatALookAddsIsASumOfItsOwnColumns() {
        val series = log { HEADING * cos(headings()[it]) }
        val search = BlindSearch(series)
        val state = search.best()
        val looks = BlindLooks(state, BlindTrials(search, state), canShowShape = true)
        val at = looks.list.indexOfFirst { it.name == "the heading" }
        val basis = Evidence.orthonormal(looks.list[at].columns)
        for (change in listOf(looks.trials[at].change, looks.refitted(at).change)) {
            assertTrue(rms(change) > 0)
            assertEquals(0.0, rms(Evidence.without(change, basis)), 1e-6 * rms(change))
        }
    }

    @Test
    fun aLookWithWaterAndNoiseOfItsOwnFindsWhatNoiseHadTaken() {
        val effect = DoubleArray(n) { HEADING * cos(headings()[it]) }
        val search = BlindSearch(log { effect[it] })
        // Noise that wanders, as a model without the effect makes of it.
        val wandering = CorrelatedNoise(times, 0.95, 10.0, BooleanArray(n) { true })
        val best = search.best()
        val noise = BlindNoise(wandering, best.fit.design.noise.spread)
        val state = search.settled(emptyList(), best.numbers, noise, best.variances, before = best)
        val looks = BlindLooks(state, BlindTrials(search, state), canShowShape = true)
        val at = looks.list.indexOfFirst { it.name == "the heading" }
        val refitted = looks.refitted(at)
        val gained = refitted.state.score - state.score
        assertTrue(gained > 2 * looks.trials[at].gain, "$gained of ${looks.trials[at].gain}")
        val off = DoubleArray(n) { refitted.change[it] - effect[it] }
        // The mean of a heading's cosine is an offset, which the water takes.
        val mean = off.average()
        assertEquals(0.0, rms(DoubleArray(n) { off[it] - mean }), 0.25 * rms(effect))
    }

    /** A period that falls between those that a look at a few hundred would have asked for, in a long log. */
    @Test
    fun aFaintPeriodIsFoundWhereverItIs() {
        val rows = 2400
        val way = CrossingTrack(rows)
        val random = java.util.Random(5)
        val noise = DoubleArray(rows) { NOISE * random.nextGaussian() }
        for (period in listOf(7.03, 23.17, 61.3)) {
            val values = DoubleArray(rows) { noise[it] + 0.0013 * cos(2 * PI * way.times[it] / period) }
            val search = BlindSearch(MeasuredSeries(way.times, way.x, way.y, values, null))
            val white = BlindNoise(CorrelatedNoise(way.times, 0.0, 1.0, search.used), DoubleArray(rows) { 1.0 })
            val state = search.settled(emptyList(), doubleArrayOf(0.02, 1.0, 0.0, 0.0), white, DoubleArray(0))
            val looks = BlindLooks(state, BlindTrials(search, state), canShowShape = true)
            val found = looks.list.last().name
            val said = Regex("period of ([0-9.]+) s").find(found)!!.groupValues[1].toDouble()
            assertEquals(period, said, period * period / (4 * rows), found)
            assertTrue(looks.trials.last().pValue < 1e-4, "$found ${looks.trials.last().pValue}")
        }
    }

    /** A walk of [rows] rows, a second apart, 0.8 m each, which turns back where it comes 90 m off, and [values] on it. */
    private fun walked(random: Random, rows: Int, values: (Int) -> Double): BlindSearch {
        val east = DoubleArray(rows)
        val north = DoubleArray(rows)
        var heading = 0.0
        for (i in 1 until rows) {
            // From a wall it turns back to the middle.
            val isOut = maxOf(abs(east[i - 1]), abs(north[i - 1])) > 90
            heading = if (isOut) atan2(-north[i - 1], -east[i - 1]) else heading + random.nextDouble(-0.5, 0.5)
            east[i] = east[i - 1] + 0.8 * cos(heading)
            north[i] = north[i - 1] + 0.8 * sin(heading)
        }
        val seconds = DoubleArray(rows) { it.toDouble() }
        return BlindSearch(MeasuredSeries(seconds, east, north, DoubleArray(rows, values), null))
    }

    /** The model in still water of which each ring has [variance] over the noise's, which is white. */
    private fun BlindSearch.inWaterOf(variance: Double): BlindState {
        val white = BlindNoise(noise(0.0, 1.0), DoubleArray(used.size) { 1.0 })
        val heights = DoubleArray(modes.bands) { if (it in modes.moving) 1e-8 else variance }
        return settled(emptyList(), doubleArrayOf(0.02, 1.0, 0.0, 0.0), white, heights, rounds = 0)
    }

    /** Of a slow period the water takes nearly all, and what it leaves is no longer one frequency. */
    @Test
    fun aPeriodThatTheWaterTakesMostOfIsFound() {
        val rows = 960
        val random = Random(7)
        for (period in listOf(31.0, 37.0, 43.0)) {
            val wave = DoubleArray(rows) { cos(2 * PI * it / period) }
            val search = walked(random, rows) { NOISE * random.nextDouble(-1.7, 1.7) + SLOW * wave[it] }
            // Water that may be anything.
            val state = search.inWaterOf(1e6)
            val seen = state.fit.whitened(wave)
            val taken = squares(state.fit.imitated(seen)) / squares(seen)
            val looks = BlindLooks(state, BlindTrials(search, state), canShowShape = true)
            val found = looks.list.last().name
            val said = Regex("period of ([0-9.]+) s").find(found)!!.groupValues[1].toDouble()
            assertTrue(taken > 0.75, "the water takes $taken")
            assertEquals(period, said, period * period / (2 * rows), found)
            assertTrue(looks.trials.last().pValue < 1e-6, "$found ${looks.trials.last().pValue}")
        }
    }

    /** Water that is bound more tightly leaves more of white noise at slow periods, which is no colour of the noise. */
    @Test
    fun whatTheWaterLeavesOfPeriodsIsAskedOfTheModelThatLeavesThem() {
        val rows = 960

        /** The same walk each time, with a period of [size]. */
        fun walked(size: Double) = Random(7).let { random ->
            walked(random, rows) { NOISE * random.nextDouble(-1.7, 1.7) + size * cos(2 * PI * it / 37) }
        }
        val state = walked(SLOW).inWaterOf(1e6)
        val look = BlindPeriods(state, BlindTrials(walked(SLOW), state)).look()
        assertContains(look.name, "period of 3")
        // Water that has next to nothing of what is noise alone.
        val other = walked(0.0).inWaterOf(0.01)
        assertEquals(1.0, look.floor(other, other.whitened), 0.5, look.name)
    }

    /** As where a clock was set after the first rows: frequencies of months would be millions. */
    @Test
    fun aLongGapDoesNotMakeFrequenciesWithoutEnd() {
        val late = DoubleArray(n) { times[it] + if (it < 60) 0.0 else 1e6 }
        val random = java.util.Random(5)
        val values = DoubleArray(n) { NOISE * random.nextGaussian() + NOISE * cos(2 * PI * late[it] / 7.03) }
        val search = BlindSearch(MeasuredSeries(late, x, y, values, null))
        val white = BlindNoise(CorrelatedNoise(late, 0.0, 1.0, search.used), DoubleArray(n) { 1.0 })
        val state = search.settled(emptyList(), doubleArrayOf(0.02, 1.0, 0.0, 0.0), white, DoubleArray(0))
        val looks = BlindLooks(state, BlindTrials(search, state), canShowShape = true)
        assertTrue(looks.list.last().searched < 2 * ln(8.0 * n), "${looks.list.last().searched}")
        assertContains(looks.list.last().name, "period of 7.0")
        assertTrue(looks.trials.last().pValue < 1e-4, "${looks.trials.last().pValue}")
    }

    @Test
    fun aResponseThatRingsIsUnexplainedAndNoCause() {
        var velocity = 0.0
        var ringing = 0.0
        val turn = 2 * PI / (4 * LAG)
        val steps = 20
        val rung = DoubleArray(n) { i ->
            repeat(steps) {
                velocity += (turn * turn * (truth[i] - ringing) - 0.3 * turn * velocity) / steps
                ringing += velocity / steps
            }
            ringing
        }
        val verdict = Diagnosis(log { 0.008 * rung[it] }).run().verdict
        assertIs<Verdict.Unexplained>(verdict)
        assertContains(verdict.what, "rings")
    }

    private fun headings() = log.heading

    private val log = MeasuredSeries(times, x, y, lagged, null)

    private companion object {
        const val LAG = 4.0
        const val NOISE = 0.004
        const val HEADING = 0.006
        const val SLOW = 0.006
    }
}
