package stillwater.diagnose.blind

import stillwater.diagnose.all
import stillwater.diagnose.evidence.Standard
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * What a curved calibration, which is no cause of the list, would explain of a log without a reference.
 *
 * Where nobody knows the water it is nearly like a lag that is faster one way than the other: of a sensor that follows
 * u' = (water − u)/τ and shows g(u) the reading follows g(water) by (d − g″/(2 g′²) d²)/τ, d = g(water) − reading, an
 * asymmetric one by (d ± a |d|)/τ. So the two are held against each other, this one with the readings z made straight:
 * (z − m)/s = v + κ v², of mean m and spread s. A density of s v is one of z by dv/dz s.
 *
 * @param state a model without it.
 */
internal class CurvedReadings(private val search: BlindSearch, private val state: BlindState) {
    private val scale = Standard(state.model.series.values)
    private val standard = scale.of(state.model.series.values)

    /** Twice the log-likelihood, as [BlindState.score], with the likeliest curvature. */
    val score: Double by lazy {
        val shares = (SHARES.flatMap { listOf(it, -it) } + 0.0).sorted()
        val tried = search.loops.all(shares, ::begun)
        val at = tried.indices.maxBy { tried[it].score }
        val near = (at - 1..at + 1).filter { it in tried.indices }.map { shares[it] to tried[it].score }
        val finer = if (near.size == NEAR) begun(top(near)) else tried[at]
        val best = maxOf(finer, tried[at], compareBy { it.score })
        best.search.fullySuited(best.state).score + best.gain
    }

    /** [state] in readings made straight; [gain] is what dv/dz adds. */
    private class Curved(val search: BlindSearch, val state: BlindState, val gain: Double) {
        val score: Double get() = state.score + gain
    }

    /** Begun with a [share] of the largest curvature with which readings rise with the water everywhere, by its sign. */
    private fun begun(share: Double): Curved {
        val farthest = if (share > 0) -standard.min() else standard.max()
        val curvature = share / (4 * farthest)
        // (dz/dv)², of standard readings.
        val slopes = DoubleArray(standard.size) { 1 + 4 * curvature * standard[it] }
        // v = (dz/dv − 1)/2κ, which is 2z/(dz/dv + 1).
        val change = DoubleArray(standard.size) { scale.spread * standard[it] * (1 - 2 / (sqrt(slopes[it]) + 1)) }
        val gain = -slopes.indices.filter { search.used[it] }.sumOf { ln(slopes[it]) }
        val straight = search.less(change)
        // Noise is of the readings as they are.
        val noise = state.fit.design.noise
        val spreads = DoubleArray(standard.size) { noise.spread[it] / sqrt(slopes[it]) }
        return Curved(straight, straight.improved(straight.again(state, noise.with(spreads))), gain)
    }

    /** Where the parabola through three [points] is highest; the middle one of them is the highest. */
    private fun top(points: List<Pair<Double, Double>>): Double {
        val (left, middle, right) = points
        val before = (middle.second - left.second) / (middle.first - left.first)
        val after = (right.second - middle.second) / (right.first - middle.first)
        val curve = (after - before) / (right.first - left.first)
        if (!(curve < 0)) return middle.first
        return (left.first + middle.first - before / curve) / 2
    }

    private companion object {
        /** Shares that are tried. */
        val SHARES = listOf(0.05, 0.1, 0.2, 0.4, 0.8)
        const val NEAR = 3
    }
}
