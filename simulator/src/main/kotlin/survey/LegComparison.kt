package stillwater.survey

import java.util.stream.IntStream
import kotlin.math.abs
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * Compares the legs of a survey with their neighbours in time.
 *
 * A leg's score is the mean, over bins along it, of |its profile − mean of the profiles of the legs before and after
 * it|; both run the other way and lie on either side, so that a linear change of the water across legs and in time
 * cancels. The null to hold it against is the same with the legs two before and two after: the same direction, so no
 * lag, but twice the distance. Lag stands out where the opposite score is larger all the same.
 *
 * Standard errors and intervals come from a bootstrap over legs in blocks of [BLOCK], because a leg takes part in the
 * scores of its neighbours, too. The water's own change between legs is in all numbers. Legs one way that lie to one side
 * of those the other way are told from a lag by how much the water differs along them over that distance.
 *
 * @param statistics of the log. @param track its track. @param seed of the bootstrap.
 */
class LegComparison(
    private val statistics: SurveyStatistics,
    private val track: Track,
    private val seed: Long = DEFAULT_SEED,
) {
    /** Leg [leg] and the legs it is held against, as indices into the legs. */
    private class Triple(val leg: Int, val before: Int, val after: Int)

    /** The comparison, or null where too few legs have opposite neighbours. Shifts are tried on all cores at once. */
    fun compare(legs: Legs): LegMismatch? {
        val list = legs.legs
        val opposite = triples(list, reach = 1)
        if (opposite.size < FEWEST_LEGS) return null
        val profiles = profiles(legs)
        profiles.follow(list)
        val shifts = shifts(list)
        // scores[triple][shift], sensor units
        val scores = List(opposite.size) { DoubleArray(shifts.size) }
        IntStream.range(0, shifts.size).parallel().forEach { s ->
            val shifted = list.map { profiles.of(it, shifts[s]) }
            for ((i, triple) in opposite.withIndex()) scores[i][s] = score(shifted, triple)
        }
        val unshifted = shifts.size / 2
        val usable = opposite.indices.filter { scores[it].all(Double::isFinite) }
        if (usable.size < FEWEST_LEGS) return null
        val same = triples(list, reach = 2).associateBy { it.leg }
        val asTaken = list.map { profiles.of(it, lag = 0.0) }
        val legScores = usable.map { i ->
            val leg = opposite[i].leg
            LegScore(leg + 1, scores[i][unshifted], same[leg]?.let { score(asTaken, it) } ?: Double.NaN)
        }
        val both = legScores.filter { it.same.isFinite() }.takeIf { it.size >= FEWEST_LEGS }
        return LegMismatch(
            legs = legs,
            scores = legScores,
            binWidth = profiles.binWidth,
            opposite = estimate(legScores.map { it.opposite }),
            paired = both?.let { found -> estimate(found.map { it.opposite }) },
            same = both?.let { found -> estimate(found.map { it.same }) },
            excess = both?.let { found -> estimate(found.map { it.opposite - it.same }) },
            shift = shift(shifts, usable.map { scores[it] }),
            aside = aside(list, usable.map { opposite[it] }, asTaken, profiles.binWidth),
        )
    }

    /** How far legs lie to one side of the middle between those before and after; null where they do not. */
    private fun aside(
        legs: List<Leg>,
        opposite: List<Triple>,
        profiles: List<DoubleArray>,
        binWidth: Double,
    ): LegAside? {
        // A boat may turn round on a circle, so that the side is another one from there on.
        val sides = opposite.map { abs(legs[it.leg].across - (legs[it.before].across + legs[it.after].across) / 2) }
        val distance = Quantiles(sides.toDoubleArray()).median
        return if (distance > LEAST_BINS * binWidth) LegAside.of(distance, profiles, binWidth) else null
    }

    private fun triples(legs: List<Leg>, reach: Int): List<Triple> {
        val usual = spacing(legs)
        return (reach until legs.size - reach).mapNotNull { i ->
            val window = legs.subList(i - reach, i + reach + 1)
            val alternating = window.zipWithNext().all { (a, b) -> a.forward != b.forward }
            val overlap = window.minOf { it.end } - window.maxOf { it.start }
            // Both neighbours must lie about as far away as neighbours usually do.
            val near = window.zipWithNext().all { (a, b) -> abs(a.across - b.across) <= MOST_SPACINGS * usual }
            Triple(i, i - reach, i + reach).takeIf { alternating && near && overlap >= legs[i].length / 2 }
        }
    }

    private fun spacing(legs: List<Leg>): Double =
        Quantiles(legs.zipWithNext { a, b -> abs(a.across - b.across) }.toDoubleArray()).median

    private fun profiles(legs: Legs): LegProfiles {
        val lengths = Quantiles(legs.legs.map { it.length }.toDoubleArray())
        val seconds = legs.legs.sumOf { it.seconds }
        val speed = legs.legs.sumOf { it.length } / seconds
        val reading = speed * statistics.steps.median * track.stride
        val width = maxOf(READINGS_A_BIN * reading, lengths.median / BINS_A_LEG)
        return LegProfiles(track, legs.axis, width, legs.legs.minOf { it.start }, legs.legs.maxOf { it.end })
    }

    private fun score(profiles: List<DoubleArray>, triple: Triple): Double {
        val middle = profiles[triple.leg]
        val before = profiles[triple.before]
        val after = profiles[triple.after]
        var sum = 0.0
        var bins = 0
        for (i in middle.indices) {
            val difference = abs(middle[i] - (before[i] + after[i]) / 2)
            if (difference.isNaN()) continue
            sum += difference
            bins++
        }
        return if (bins >= FEWEST_BINS) sum / bins else Double.NaN
    }

    /** Shifts from −limit to limit, s, an odd number with 0 in the middle. */
    private fun shifts(legs: List<Leg>): DoubleArray {
        val limit = Quantiles(legs.map { it.seconds }.toDoubleArray()).median * LARGEST_SHIFT
        val step = maxOf(statistics.steps.median * track.stride / 2, limit / MOST_SHIFTS)
        val each = (limit / step).toInt().coerceAtLeast(2)
        return DoubleArray(2 * each + 1) { (it - each) * step }
    }

    private fun shift(shifts: DoubleArray, scores: List<DoubleArray>): LagShift {
        val curve = DoubleArray(shifts.size) { s -> scores.sumOf { it[s] } / scores.size }
        val best = curve.indices.minBy { curve[it] }
        val random = Random(seed)
        val samples = Array(RESAMPLES) { resample(scores.size, random) }
        // byShift[shift][leg]: sums go along an array, and all cores take part in them.
        val byShift = Array(shifts.size) { s -> DoubleArray(scores.size) { leg -> scores[leg][s] } }
        val found = DoubleArray(RESAMPLES)
        IntStream.range(0, RESAMPLES).parallel().forEach { found[it] = shifts[least(byShift, samples[it])] }
        val interval = Quantiles(found)
        // A resample's own best shift may lie anywhere between the one found and the next.
        val half = (shifts[1] - shifts[0]) / 2
        return LagShift(
            seconds = shifts[best],
            low = interval[LOW] - half,
            high = interval[1 - LOW] + half,
            mismatch = curve[best],
            gain = estimate(scores.map { it[shifts.size / 2] - it[best] }),
            legs = scores.size,
            limit = shifts.last(),
            shifts = shifts,
            curve = curve,
        )
    }

    /** The first of the shifts with the least sum over [legs]. */
    private fun least(byShift: Array<DoubleArray>, legs: IntArray): Int {
        var best = 0
        var least = Double.POSITIVE_INFINITY
        for (s in byShift.indices) {
            val scores = byShift[s]
            val sum = legs.sumOf { scores[it] }
            if (sum < least) {
                least = sum
                best = s
            }
        }
        return best
    }

    private fun estimate(scores: List<Double>): Estimate {
        // Then every sample has each leg once, and all are alike.
        if (scores.size <= BLOCK) return Estimate(scores.average(), Double.NaN)
        val random = Random(seed)
        val means = DoubleArray(RESAMPLES) { resample(scores.size, random).sumOf { scores[it] } / scores.size }
        val mean = means.average()
        val variance = means.sumOf { (it - mean) * (it - mean) } / (means.size - 1)
        return Estimate(scores.average(), sqrt(variance))
    }

    /** [count] indices below [count], in runs of [BLOCK] that go around the end. */
    private fun resample(count: Int, random: Random): IntArray {
        val indices = IntArray(count)
        var start = 0
        for (i in indices.indices) {
            if (i % BLOCK == 0) start = random.nextInt(count)
            indices[i] = (start + i % BLOCK) % count
        }
        return indices
    }

    companion object {
        /** Legs in a block of the bootstrap. */
        const val BLOCK = 3

        /** Seed of the bootstrap unless said otherwise. */
        const val DEFAULT_SEED = 1L

        private const val FEWEST_LEGS = 3
        private const val FEWEST_BINS = 5

        /** Bins along the legs; legs that lie less aside are in the same water. */
        private const val LEAST_BINS = 0.1
        private const val MOST_SPACINGS = 3.0
        private const val READINGS_A_BIN = 3.0
        private const val BINS_A_LEG = 50.0
        private const val LARGEST_SHIFT = 1.0 / 6
        private const val MOST_SHIFTS = 60.0
        private const val RESAMPLES = 500
        private const val LOW = 0.025
    }
}

private inline fun IntArray.sumOf(term: (Int) -> Double): Double {
    var sum = 0.0
    for (index in this) sum += term(index)
    return sum
}
