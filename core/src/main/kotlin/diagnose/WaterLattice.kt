package stillwater.diagnose

import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Plane waves of all directions that are periodic in a box about a track, which is wider than the track by the way they
 * need to bend to each other's values: any water whose waves are longer than the shortest is near a sum of them.
 *
 * A wave has one length, so that each ring of lengths can have a variance of its own, and as many are needed as
 * the area holds squares of half the shortest length: fewer than of any other waves where a track fills an area.
 *
 * Source: Huybrechs 2010, On the Fourier extension of nonperiodic functions, doi:10.1137/090752456.
 *
 * @param x metres east. @param y metres north. @param most waves at most. @param least the shortest length allowed, m.
 * @param wider by how much of the track's size the box is wider at least.
 */
internal class WaterLattice(
    private val x: DoubleArray,
    private val y: DoubleArray,
    most: Int,
    least: Double,
    private val wider: Double,
) {
    private val turn = (0 until TURNS).map { it * PI / 2 / TURNS }.minBy { width(it) * height(it) }
    private val width = width(turn)
    private val height = height(turn)

    /** Length of the shortest wave, m. */
    val shortest: Double = run {
        var low = least
        var high = maxOf(2 * hypot(width, height), 2 * least)
        if (numbers(low).size * 2 + 2 > most) {
            repeat(HALVINGS) {
                val middle = sqrt(low * high)
                if (numbers(middle).size * 2 + 2 > most) low = middle else high = middle
            }
            high
        } else {
            low
        }
    }

    private fun along(angle: Double, i: Int) = x[i] * cos(angle) + y[i] * sin(angle)

    private fun width(angle: Double) = x.indices.maxOf { along(angle, it) } - x.indices.minOf { along(angle, it) }

    private fun height(angle: Double) = width(angle + PI / 2)

    /** The wave numbers over 2π, 1/m, of half a plane, the longest waves first. */
    private fun numbers(length: Double): List<Pair<Double, Double>> {
        val pad = maxOf(PAD * length, wider * hypot(width, height))
        val east = width + pad
        val north = height + pad
        val j = (east / length).toInt()
        val k = (north / length).toInt()
        // Far too many need not be counted.
        if (j.toLong() * k > FAR) return List(FAR.toInt()) { 0.0 to 0.0 }
        return (0..j).flatMap { a -> (-k..k).map { b -> a / east to b / north } }
            .filter { (p, q) -> (p > 0 || q > 0) && hypot(p, q) * length <= 1 }.sortedBy { (p, q) -> hypot(p, q) }
    }

    /** The rings of waves from the longest to the shortest, each a list of columns; the first are slopes. */
    fun rings(): List<List<DoubleArray>> {
        val a = DoubleArray(x.size) { along(turn, it) }
        val b = DoubleArray(x.size) { along(turn + PI / 2, it) }
        val slopes = listOf(a to width, b to height).map { (way, size) ->
            val middle = (way.max() + way.min()) / 2
            DoubleArray(way.size) { (way[it] - middle) / maxOf(size, 1e-9) }
        }
        val numbers = numbers(shortest)
        val rings = numbers.groupBy { (p, q) -> ring(hypot(p, q) * shortest) }.toSortedMap().values
        return listOf(slopes) + rings.map { ring ->
            ring.flatMap { (p, q) ->
                val phase = DoubleArray(x.size) { 2 * PI * (p * a[it] + q * b[it]) }
                listOf(DoubleArray(x.size) { cos(phase[it]) }, DoubleArray(x.size) { sin(phase[it]) })
            }
        }
    }

    /** The shortest wave of each of [rings], m; that of the slopes first. */
    fun lengths(): List<Double> {
        val longest = numbers(shortest).groupBy { (p, q) -> ring(hypot(p, q) * shortest) }.toSortedMap()
        return listOf(Double.POSITIVE_INFINITY) +
            longest.values.map { ring -> 1 / ring.maxOf { (p, q) -> hypot(p, q) } }
    }

    /** Rings ever finer towards the longest waves; the [share] of the largest wave number. */
    private fun ring(share: Double): Int {
        var ring = 0
        var edge = 1 / FACTOR
        while (share <= edge && ring > -MOST_RINGS + 1) {
            ring--
            edge /= FACTOR
        }
        return ring
    }

    private companion object {
        const val TURNS = 18
        const val PAD = 2.0
        const val HALVINGS = 24
        const val FACTOR = 1.4
        const val MOST_RINGS = 7
        const val FAR = 20_000L
    }
}
