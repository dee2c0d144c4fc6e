package stillwater.survey

import org.junit.jupiter.api.Test
import kotlin.math.floor
import kotlin.random.Random
import kotlin.test.assertContentEquals
import kotlin.test.assertTrue

/** The means along legs against a naive way, which looks up where the boat was for each reading anew. */
class LegProfilesTest {
    @Test
    fun theyAreThoseOfPlacesLookedUpOneByOneToTheLastBit() {
        var filled = 0
        repeat(40) { seed ->
            val random = Random(seed)
            val track = track(random)
            val leg = Leg(30, 90, forward = true, start = 0.0, end = 60.0, across = 0.0, seconds = 1.0)
            val profiles = LegProfiles(track, axis = 0.0, binWidth = random.nextDouble(0.3, 9.0), from = 3.0, to = 55.0)
            profiles.follow(listOf(leg))
            for (lag in listOf(0.0, 0.5, -0.5, 7.0, -7.0, random.nextDouble(-90.0, 90.0))) {
                val expected = naive(track, leg, profiles, lag)
                filled += expected.count { !it.isNaN() }
                assertContentEquals(expected, profiles.of(leg, lag), "seed $seed, lag $lag")
            }
        }
        // The comparison is not one of empty profiles.
        assertTrue(filled > 1000, "$filled bins with readings")
    }

    /** A boat that wavers, stands still and goes back; some times are the same, many places lie on a bin's border. */
    private fun track(random: Random): Track {
        val times = DoubleArray(SIZE)
        val xs = DoubleArray(SIZE)
        for (i in 1 until SIZE) {
            times[i] = times[i - 1] + listOf(0.0, 0.5, 0.5, 0.1, random.nextDouble()).random(random)
            xs[i] = xs[i - 1] + listOf(0.0, 1.0, 1.0, 1.0, random.nextDouble(-2.0, 3.0)).random(random)
        }
        val shift = xs[30]
        for (i in xs.indices) xs[i] -= shift
        return Track(times, xs, DoubleArray(SIZE), DoubleArray(SIZE) { random.nextDouble() })
    }

    private fun naive(track: Track, leg: Leg, profiles: LegProfiles, lag: Double): DoubleArray {
        val origin = floor(3.0 / profiles.binWidth) * profiles.binWidth
        val taken = Array(profiles.bins) { ArrayList<Double>() }
        for (i in 0 until track.size) {
            val seconds = track.times[i] - lag
            if (seconds < track.times[leg.first] || seconds > track.times[leg.last]) continue
            val at = (leg.first until leg.last).first { seconds <= track.times[it + 1] }
            val span = track.times[at + 1] - track.times[at]
            val share = if (span > 0) (seconds - track.times[at]) / span else 0.0
            val bin = floor((track.xs[at] + (track.xs[at + 1] - track.xs[at]) * share - origin) / profiles.binWidth)
            taken.getOrNull(bin.toInt())?.add(track.values[i])
        }
        return DoubleArray(taken.size) { if (taken[it].isEmpty()) Double.NaN else taken[it].sum() / taken[it].size }
    }

    private companion object {
        const val SIZE = 120
    }
}
