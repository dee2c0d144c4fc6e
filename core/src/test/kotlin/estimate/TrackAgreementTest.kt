package stillwater.estimate

import org.junit.jupiter.api.Test
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class TrackAgreementTest {
    private fun series(size: Int, x: (Double) -> Double, y: (Double) -> Double) = TrackSeries(
        DoubleArray(size) { it.toDouble() },
        DoubleArray(size) { x(it.toDouble()) },
        DoubleArray(size) { y(it.toDouble()) },
        DoubleArray(size),
    )

    private fun water(x: Double, y: Double) = sin(x / 8) + cos(y / 7)

    /** A boat that goes round and across, so that its track crosses itself at all angles. */
    private fun wound(size: Int = 3000) = series(size, { 50 * sin(0.021 * it) }, { 50 * sin(0.0297 * it) })

    private fun normal(random: Random) = sqrt(-2 * kotlin.math.ln(1 - random.nextDouble())) *
        cos(2 * Math.PI * random.nextDouble())

    /** The water along [series] as it was [late] seconds before, with noise of which the intervals know. */
    private fun corrected(series: TrackSeries, late: Double, noise: Double = 0.02): CorrectedTrack {
        // A smoothed track's errors are those of its neighbours.
        val random = Random(SEED)
        val errors = DoubleArray(series.size / 15 + 1) { noise * normal(random) }
        val values = DoubleArray(series.size) {
            val t = series.times[it] - late
            water(50 * sin(0.021 * t), 50 * sin(0.0297 * t)) + errors[it / 15]
        }
        fun moved(by: Double) = DoubleArray(values.size) { values[it] + by }
        val none = BooleanArray(values.size)
        return CorrectedTrack(values, moved(-1.96 * noise), moved(1.96 * noise), none, none)
    }

    private fun covered(series: TrackSeries, track: CorrectedTrack) = track.values.indices.count {
        water(series.xs[it], series.ys[it]) in track.lower[it]..track.upper[it]
    } / track.values.size.toDouble()

    @Test
    fun crossingIsWhereTwoPassesMeet() {
        // East along y = 0, round, and north along x = 5.25 from t = 60 on, which is at y = 0.5 at t = 71.
        fun x(t: Double) = if (t < 30) {
            t
        } else if (t < 60) {
            30.0
        } else {
            5.25
        }

        fun y(t: Double) = if (t < 30) {
            0.0
        } else if (t < 60) {
            t - 100
        } else {
            t - 70.5
        }
        val track = series(90, ::x, ::y)
        val found = TrackCrossings(track)
        assertEquals(1, found.size)
        assertEquals(listOf(5, 70), listOf(found.one(0), found.other(0)))
        assertEquals(0.25, found.shareOne(0), 1e-9)
        assertEquals(0.5, found.shareOther(0), 1e-9)
    }

    @Test
    fun neitherRestNorLinesBesideEachOtherAreCrossings() {
        assertEquals(0, TrackCrossings(series(500, { 0.0 }, { 0.0 })).size)
        val legs = series(
            400,
            { if ((it / 100).toInt() % 2 == 0) it % 100 else 99 - it % 100 },
            { 5.0 * (it / 100).toInt() },
        )
        assertEquals(0, TrackCrossings(legs).size)
    }

    @Test
    fun onALineEachPlaceIsComparedWithTheNextPass() {
        val casts = series(300, { if (it % 100 < 50) it % 100 else 100 - it % 100 }, { 0.0 })
        val found = TrackCrossings(casts)
        assertTrue(found.size > 200, "${found.size}")
        for (k in 0 until found.size) {
            val there = casts.xs[found.other(k)]
            val next = casts.xs[found.other(k) + 1]
            val x = there + found.shareOther(k) * (next - there)
            assertEquals(casts.xs[found.one(k)], x, 1e-9)
            assertTrue(found.other(k) - found.one(k) > TrackCrossings.LEAST_STEPS)
        }
    }

    @Test
    fun intervalsThatHoldAreLeftAlone() {
        val series = wound()
        val track = corrected(series, late = 0.0)
        val agreement = TrackAgreement.of(series, track)
        assertTrue(agreement.crossings > 100, "${agreement.crossings}")
        // Five standard errors: other noise would do as well.
        assertEquals(1.0, agreement.ratio, 5 * agreement.error)
        assertFalse(agreement.isContradicted, "seed $SEED: ${agreement.ratio} ± ${agreement.error}")
        assertTrue(agreement.widened(track) === track)
    }

    @Test
    fun aLagLeftOverWidensThemUntilTheyHold() {
        val series = wound()
        val track = corrected(series, late = 1.0)
        val agreement = TrackAgreement.of(series, track)
        assertTrue(agreement.isContradicted, "${agreement.ratio} ± ${agreement.error}")
        // A tenth: the slope is a difference over five rows.
        assertEquals(1.0, agreement.lateness, 0.1)
        assertTrue(covered(series, track) < 0.6)
        val wider = agreement.widened(track)
        assertTrue(covered(series, wider) > 0.93, "${covered(series, wider)}")
        assertTrue(wider.values === track.values)
    }

    /** A slope goes on for as long as the water does, and not for as long as times may be wrong. */
    @Test
    fun wrongTimesWidenIntervalsNoFartherThanTheTrackGoes() {
        val series = wound()
        val track = corrected(series, late = 0.0)
        val agreement = TrackAgreement.of(series, track)
        val range = track.values.max() - track.values.min()
        val far = agreement.widened(track, late = 1000.0)
        val half = track.upper.indices.maxOf { track.upper[it] - track.values[it] }
        for (row in far.values.indices) {
            assertTrue(far.upper[row] - far.values[row] <= range + half, "row $row: ${far.upper[row]}")
        }
        // Of times that are hardly wrong the slope says it all.
        val near = agreement.widened(track, late = 0.1)
        assertTrue(near.meanHalfWidth > track.meanHalfWidth && near.meanHalfWidth < far.meanHalfWidth)
    }

    @Test
    fun intervalsOfNoWidthAreContradictedByPassesThatDiffer() {
        val series = wound()
        val agreement = TrackAgreement.of(series, corrected(series, late = 0.0).withoutWidth { it })
        assertTrue(agreement.isContradicted, "${agreement.ratio} ± ${agreement.error}")
        assertTrue(agreement.lateness.isFinite() && agreement.spread.isFinite())
        val level = TrackAgreement.of(series, corrected(series, late = 0.0).withoutWidth { 0.0 })
        assertEquals(0.0, level.ratio)
        assertFalse(level.isContradicted)
    }

    private fun CorrectedTrack.withoutWidth(value: (Double) -> Double): CorrectedTrack {
        val same = DoubleArray(values.size) { value(values[it]) }
        return CorrectedTrack(same, same, same, silent, outlying)
    }

    @Test
    fun fewCrossingsShowNothing() {
        val straight = series(100, { it }, { 0.5 * it })
        val agreement = TrackAgreement.of(straight, corrected(straight, 0.0))
        assertEquals(0, agreement.crossings)
        assertTrue(agreement.ratio.isNaN())
        assertFalse(agreement.isContradicted)
    }

    /** [size] readings of a lag of 8 s in water of two waves, or of a ramp, with noise of 0.01. */
    private fun reference(size: Int, step: Double, waves: Boolean): Pair<TrackSeries, DoubleArray> {
        val random = Random(SEED)
        val times = DoubleArray(size) { step * it }
        fun at(t: Double) = if (waves) sin(t / 19) + 0.5 * sin(t / 11) else 0.0005 * t
        var shown = at(0.0)
        val fine = 50
        val values = DoubleArray(size) { i ->
            if (i > 0) {
                for (k in 1..fine) {
                    val water = at(times[i] - step + step * k / fine)
                    shown += (1 - exp(-step / fine / 8)) * (water - shown)
                }
            }
            shown + 0.01 * normal(random)
        }
        return TrackSeries(times, times, DoubleArray(size), values) to DoubleArray(size) { at(times[it]) }
    }

    @Test
    fun aReferenceSaysWhichLagsItLeavesOpen() {
        val (long, truth) = reference(600, 1.0, waves = true)
        val range = ReferenceLearner(long, truth).lagRange()
        assertTrue(range.start > 4 && range.endInclusive < 16, "$range")
        val (short, ramp) = reference(30, 1.0, waves = false)
        val open = ReferenceLearner(short, ramp).lagRange()
        assertEquals(0.0, open.start)
        assertEquals(Double.POSITIVE_INFINITY, open.endInclusive)
    }

    @Test
    fun aReferenceWithRowsFarApartIsRough() {
        val (dense, truth) = reference(600, 1.0, waves = true)
        assertTrue(ReferenceLearner(dense, truth).roughness() < 0.5)
        val (sparse, known) = reference(60, 20.0, waves = true)
        assertTrue(ReferenceLearner(sparse, known).roughness() > 0.5)
    }

    private companion object {
        const val SEED = 20261122
    }
}
