package stillwater.diagnose.evidence

import java.util.Random
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Chances of the best of many places for jumps, against simulations and sums that are known. */
class JumpScanTest {
    private val rows = 600
    private val edge = 12

    /** What the best jump gains of white noise whose mean is fitted: sums of the first rows say all. */
    private fun best(random: Random): Double {
        val noise = DoubleArray(rows) { random.nextGaussian() }
        val mean = noise.average()
        var sum = 0.0
        return noise.indices.maxOf { k ->
            sum += noise[k] - mean
            val left = k + 1.0
            if (k + 1 in edge until rows - edge) sum * sum * rows / left / (rows - left) else 0.0
        }
    }

    /** Angles between jumps after k rows and after k + 1 under white noise. */
    private fun steps() = DoubleArray(rows - 2 * edge - 1) {
        val k = (edge + it).toDouble()
        sqrt(2 * (1 - sqrt(k * (rows - k - 1) / (k + 1) / (rows - k))))
    }

    /** 3000 logs: the standard error of a share of 5 % is 0.4 %, of 1 % 0.2 %. */
    @Test
    fun theBestPlaceGainsByChanceAsOftenAsIsSaid() {
        val random = Random(20_262)
        val scan = JumpScan(steps(), 1.0)
        val chances = List(3000) { scan.single(best(random)) }
        assertEquals(0.05, chances.count { it < 0.05 } / 3000.0, 0.013)
        assertEquals(0.01, chances.count { it < 0.01 } / 3000.0, 0.006)
    }

    /** Of places that say nothing of each other the best two are the largest squares; a pair has half of the chance. */
    @Test
    fun twoJumpsPayForEachPairOfPlaces() {
        val random = Random(20_263)
        val scan = JumpScan(DoubleArray(99) { sqrt(2.0) }, 1.0)
        val often = List(400) {
            val squares = List(100) { random.nextGaussian().let { z -> z * z } }.sortedDescending()
            scan.pValue(squares[0] + squares[1], 2)
        }.count { it < 0.1 } / 400.0
        // Pairs with a place in common are counted as if they had none: less often than is said.
        assertTrue(often in 0.005..0.05, "$often")
    }

    /** What is gained far beyond chance costs no more to weigh than what is gained a little beyond it. */
    @Test
    fun anEnormousGainIsNoChance() {
        val scan = JumpScan(steps(), 1.0)
        for (count in 1..3) {
            val p = scan.pValue(1e5, count)
            assertEquals(scan.pValue(300.0, count), p)
            assertTrue(p < 1e-40, "$p")
        }
    }

    @Test
    fun nothingIsGainedForNothing() {
        val scan = JumpScan(steps(), 1.0)
        for (count in 1..3) for (gain in listOf(-1.0, 0.0, 0.5)) assertEquals(1.0, scan.pValue(gain, count))
    }
}
