package stillwater.diagnose.water

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class WaterRingsTest {
    private val n = 400

    /** A way that turns at random, as a boat that drifts. */
    private val way = run {
        val random = Random(SEED)
        var heading = 0.0
        var east = 0.0
        var north = 0.0
        List(n) {
            heading += 0.15 * random.nextDouble(-1.0, 1.0)
            east += cos(heading)
            north += sin(heading)
            east to north
        }
    }
    private val x = DoubleArray(n) { way[it].first }
    private val y = DoubleArray(n) { way[it].second }
    private val rings = WaterRings(x, y, least = 8.0)

    @Test
    fun aDiscOfWavesHasTheCovarianceOfTheirMean() {
        val kernel = DiscKernel()
        for (d in listOf(0.0, 0.3, 1.7, 5.2, 23.0, 61.8)) {
            // The mean of cos(k d) over the disc |k| < 1: rings of radius k and 2 pi k dk waves.
            val steps = 4000
            val mean = (0 until steps).sumOf { i ->
                val k = (i + 0.5) / steps
                val turns = 400
                2 * k / steps * (0 until turns).sumOf { cos(k * d * cos(PI * (it + 0.5) / turns)) } / turns
            }
            assertEquals(mean, kernel.at(d), 2e-6, "at $d")
        }
    }

    @Test
    fun columnsHaveTheCovarianceOfTheirRings() {
        val spectrum = DoubleArray(rings.size) { if (it < 5) 1.0 / (it + 1) else 0.0 }
        val columns = rings.columns(spectrum, left = 1e-8, most = n).all.map { it.second }
        assertTrue(columns.size < n, "${columns.size} columns")
        val lengths = rings.lengths
        fun covariance(d: Double): Double {
            val kernel = DiscKernel()
            var inner = 0.0
            return (0 until 5).sumOf { ring ->
                val k = 2 * PI / lengths[ring]
                val own = k * k * kernel.at(k * d) - inner * inner * kernel.at(inner * d)
                val all = k * k - inner * inner
                inner = k
                spectrum[ring] * own / all
            }
        }
        for ((a, b) in listOf(0 to 0, 3 to 5, 100 to 130, 17 to 380, 250 to 252)) {
            val shown = columns.sumOf { it[a] * it[b] }
            assertEquals(covariance(hypot(x[a] - x[b], y[a] - y[b])), shown, 1e-6, "rows $a and $b, seed $SEED")
        }
    }

    @Test
    fun aWaveIsShownByTheRingsDownToItsOwn() {
        val ring = rings.size - 3
        val columns = rings.columns(DoubleArray(rings.size) { 1.0 }, left = 1e-7, most = n).all
        val length = (rings.lengths[ring] + rings.lengths[ring - 1]) / 2
        val waves = List(8) { k ->
            val turn = PI * k / 8
            DoubleArray(n) { sin(2 * PI / length * (cos(turn) * x[it] + sin(turn) * y[it]) + 1) }
        }
        val enough = columns.filter { it.first <= ring + 1 }.map { it.second }
        assertTrue(waves.all { left(it, enough) < 0.03 }, "seed $SEED")
        // Across the way a wave looks longer than it is.
        val fewer = columns.filter { it.first < ring - 1 }.map { it.second }
        assertTrue(waves.count { left(it, fewer) > 0.3 } >= 4, "seed $SEED")
    }

    @Test
    fun ringsThatAreAsStrongAreAsManyAsColumnsCanShow() {
        val coarsest = rings.coarsest(60)
        fun columns(count: Int) =
            rings.columns(DoubleArray(rings.size) { if (it < count) 1.0 else 0.0 }, 1e-6 * count, n).all.size
        assertTrue(columns(coarsest) <= 60 && columns(coarsest + 1) > 60, "$coarsest")
    }

    /** What the best sum of [columns] leaves of [wave], root mean square over the wave's. */
    private fun left(wave: DoubleArray, columns: List<DoubleArray>): Double {
        val rest = Evidence.without(wave, Evidence.orthonormal(columns))
        return sqrt(squares(rest) / squares(wave))
    }

    private companion object {
        const val SEED = 20261122
    }
}
