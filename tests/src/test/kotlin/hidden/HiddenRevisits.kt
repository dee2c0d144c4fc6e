package stillwater.hidden

import stillwater.field.Field
import stillwater.model.BoatTime
import kotlin.math.hypot

/**
 * How strong an even change of the water must be to show where a track comes back to a place that a reference has seen.
 *
 * Each return, once a meeting, tells the change Δt · rate with an error of the fixes' jitter along the water's slope
 * and of the reference's noise, twice. λ is the sum of their squared ratios; 1x is √λ = 6.36 as for all effects.
 */
internal class HiddenRevisits(private val world: HiddenWorld, private val jitter: Double, private val noise: Double) {
    private val rows = world.rows

    /** The detectable change over the whole log, in the field's own spread; infinite where there is no return. */
    fun detectable(): Double {
        val error = 2 * (slope() * world.amplitude * maxOf(jitter, LEAST_JITTER)).let { it * it } + 2 * noise * noise
        val lambda = returns().sumOf { (i, j) ->
            val share = (j - i).toDouble() / rows
            (share * world.amplitude).let { it * it } / error
        }
        return DetectableSize.DETECTABLE / kotlin.math.sqrt(lambda)
    }

    private fun x(row: Int) = world.track.x[(row + 1) * world.per]

    private fun y(row: Int) = world.track.y[(row + 1) * world.per]

    /** For each row the nearest later visit, where that is nearer than those of the rows beside it. */
    private fun returns(): List<Pair<Int, Int>> {
        val reach = hypot(x(1) - x(0), y(1) - y(0))
        val nearest = List(rows) { i ->
            (i + APART until rows).map { j -> j to hypot(x(j) - x(i), y(j) - y(i)) }.minByOrNull { it.second }
        }
        return (1 until rows - 1).mapNotNull { i ->
            val (j, distance) = nearest[i] ?: return@mapNotNull null
            val beside = listOf(i - 1, i + 1).mapNotNull { nearest[it]?.second }
            if (distance < reach && beside.all { it >= distance }) i to j else null
        }
    }

    /** Root mean square of the field's slope along the track, 1/m. */
    private fun slope(): Double {
        fun at(field: Field, x: Double, y: Double) = field.truth(x, y, BoatTime(0.0))
        return kotlin.math.sqrt(
            (0 until rows).sumOf { row ->
                val east = at(world.field, x(row) + HALF, y(row)) - at(world.field, x(row) - HALF, y(row))
                val north = at(world.field, x(row), y(row) + HALF) - at(world.field, x(row), y(row) - HALF)
                east * east + north * north
            } / rows,
        )
    }

    private companion object {
        const val APART = 40
        const val HALF = 0.5

        /** The way between rows is not straight: as good as this jitter, m. */
        const val LEAST_JITTER = 0.1
    }
}
