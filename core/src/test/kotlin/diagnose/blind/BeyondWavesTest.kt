package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Term
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import java.util.Random
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Water with long waves and, far below these, short ones that a model lacks although its own finest hold nothing. */
class BeyondWavesTest {
    private val track = CrossingTrack(ROWS)
    private val series = run {
        val shown = track.shown(LAG) { x, y -> sin(x / 6) + sin(y / 7 + 1) + SHORT * (sin(x) + sin(0.9 * y)) }
        val random = Random(SEED)
        val values = DoubleArray(ROWS) { shown[it] + NOISE * random.nextGaussian() }
        MeasuredSeries(track.times, track.x, track.y, values, null)
    }
    private val search = BlindSearch(series)
    private val coarse = state(shortest = 10.0)
    private val fine = state(shortest = 4.5)

    private fun state(shortest: Double): BlindState {
        val white = CorrelatedNoise(track.times, 0.0, 10.0, BooleanArray(ROWS) { true })
        val modes = WaterModes.flat(series, SmoothTrack.of(series), MOST, shortest)
        val noise = BlindNoise(white, DoubleArray(ROWS) { 1.0 })
        return search.settled(emptyList(), doubleArrayOf(LAG, 1.0, 0.0, 0.0), noise, DoubleArray(0), ROUNDS, modes)
    }

    private fun isKept(cause: Cause, share: Double, on: BlindState, with: BlindState): Boolean {
        val ratio = share * ROWS
        val trial = BlindTrial(Term(cause), cause.label, null, null, DoubleArray(ROWS), ratio, 1.0, 1, 0.0, with, ratio)
        return BeyondWaves(search, on).of(trial).ratio == ratio
    }

    @Test
    fun shortWavesShowAlthoughTheFinestOfTheModelAreWeak() {
        assertTrue(coarse.isResolved && fine.isResolved)
        assertTrue(FinerWaves.show(coarse, search), "${FinerWaves.excess(coarse, search)}, seed $SEED")
        assertFalse(FinerWaves.show(fine, search), "${FinerWaves.excess(fine, search)}, seed $SEED")
    }

    @Test
    fun whatExplainsMoreThanTheyMayCounts() {
        for ((cause, least) in listOf(Cause.HYSTERESIS to 0.09, Cause.DEAD_TIME to 0.25)) {
            val kept = listOf(0.9, 1.1).map { isKept(cause, it * least, on = coarse, with = coarse) }
            assertEquals(listOf(false, true), kept, "$cause")
        }
        assertTrue(isKept(Cause.DRIFT, 1e-3, on = coarse, with = coarse))
    }

    @Test
    fun anyCauseCountsWhereNoneShow() {
        for (cause in listOf(Cause.HYSTERESIS, Cause.DEAD_TIME)) {
            assertTrue(isKept(cause, 1e-3, on = fine, with = fine), "$cause")
        }
    }

    @Test
    fun aResponseWithWhichNoneShowCounts() {
        assertTrue(isKept(Cause.DEAD_TIME, 1e-3, on = coarse, with = fine))
    }

    @Test
    fun looksCountWithWaterThatLacksNone() {
        val ring = BlindLook("a ring", emptyList(), ofWater = true)
        val value = BlindLook("the value", emptyList()) { emptyList() }
        val heading = BlindLook("the heading", emptyList(), ofBoat = true)
        val trial = BlindTrial(null, "", null, null, DoubleArray(ROWS), 0.08 * ROWS, 1.0, 1, 0.0)
        val looks = listOf(ring, value, heading)
        val onCoarse = BeyondWaves(search, coarse)
        val onFine = BeyondWaves(search, fine)
        assertEquals(listOf(false, false, true), looks.map { onCoarse.of(it, trial, coarse) === trial })
        assertEquals(listOf(true, true, true), looks.map { onCoarse.of(it, trial, fine) === trial })
        assertEquals(listOf(false, false, true), looks.map { onCoarse.of(it, trial) === trial })
        assertEquals(listOf(true, true, true), looks.map { onFine.of(it, trial) === trial })
    }

    private companion object {
        const val SEED = 20261201L
        const val ROWS = 1000
        const val LAG = 3.0
        const val NOISE = 0.02
        const val SHORT = 0.04
        const val MOST = 260
        const val ROUNDS = 12
    }
}
