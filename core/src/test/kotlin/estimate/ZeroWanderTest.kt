package stillwater.estimate

import org.junit.jupiter.api.Test
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertFalse
import kotlin.test.assertSame
import kotlin.test.assertTrue

/** A lawnmower's legs of 100 m, 5 m apart, over water that changes over 25 m, read without a lag. */
class ZeroWanderTest {
    private val size = 2000
    private val times = DoubleArray(size) { it.toDouble() }
    private val xs = DoubleArray(size) { 5.0 * (it / 100) }
    private val ys = DoubleArray(size) { if (it / 100 % 2 == 0) it % 100.0 else 100.0 - it % 100 }

    private fun normal(random: Random) = sqrt(-2 * ln(1 - random.nextDouble())) * cos(2 * PI * random.nextDouble())

    private fun water(seed: Int): DoubleArray {
        val random = Random(seed)
        val waves = List(60) { Triple(normal(random) / 25, normal(random) / 25, random.nextDouble(2 * PI)) }
        return DoubleArray(size) { row ->
            sqrt(2.0 / 60) * waves.sumOf { (a, b, c) -> cos(a * xs[row] + b * ys[row] + c) }
        }
    }

    private fun track(values: DoubleArray) = CorrectedTrack(
        values,
        DoubleArray(size) { values[it] - 0.04 },
        DoubleArray(size) { values[it] + 0.04 },
        BooleanArray(size),
        BooleanArray(size),
    )

    @Test
    fun intervalsHoldAZeroThatWanders() {
        val covered = (1..4).map { seed ->
            val water = water(seed)
            val random = Random(100 + seed)
            var off = 0.0
            val track = track(
                DoubleArray(size) {
                    off += 0.01 * normal(random)
                    water[it] + off + 0.01 * normal(random)
                },
            )
            val wander = ZeroWander.of(TrackSeries(times, xs, ys, track.values), track)
            assertTrue(wander.isSeen, "${wander.still}")
            val wide = wander.widened(track)
            assertSame(track.values, wide.values)
            (0 until size).count { water[it] in wide.lower[it]..wide.upper[it] } / size.toDouble()
        }
        // Of four walks one may be beyond its interval for a part of its way.
        assertTrue(covered.average() > 0.85, "$covered")
    }

    @Test
    fun aZeroThatKeepsStillWidensNothing() {
        for (seed in 1..4) {
            val random = Random(200 + seed)
            val water = water(seed)
            val track = track(DoubleArray(size) { water[it] + 0.01 * normal(random) })
            val wander = ZeroWander.of(TrackSeries(times, xs, ys, track.values), track)
            assertFalse(wander.isSeen, "${wander.still}")
            assertSame(track, wander.widened(track))
        }
    }
}
