package stillwater.diagnose.evidence

import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Single wrong readings among normal noise, and noise with heavy tails and none. */
class SpikesTest {
    private val n = 1200

    /** The sum of twelve even numbers is nearly normal, of variance 1. */
    private fun Random.normal() = List(12) { nextDouble() }.sum() - 6

    @Test
    fun outliersAreLikelierThanHeavyTailsWhereThereAreOutliers() {
        val random = Random(5)
        val noise = DoubleArray(n) { random.normal() }
        for (i in 50 until n step 100) noise[i] += random.nextDouble(-9.0, 9.0)
        val ratio = Spikes.ratio(noise).ratio
        assertTrue(ratio > 30 && ratio > Spikes.student(noise).ratio, "$ratio against ${Spikes.student(noise).ratio}")
    }

    @Test
    fun heavyTailsAreLikelierWhereTheNoiseHasThem() {
        val random = Random(6)
        // Student's t with five degrees of freedom.
        val noise = DoubleArray(n) { random.normal() / sqrt(List(5) { random.normal() }.sumOf { it * it } / 5) }
        val ratio = Spikes.ratio(noise).ratio
        assertTrue(Spikes.student(noise).ratio > ratio && ratio > 30, "$ratio against ${Spikes.student(noise).ratio}")
        // Of t with five degrees 0.5 % are beyond 4.773 and 0.2 % beyond 5.893, either way.
        val share = Spikes.student(noise).beyond(5.0)
        assertTrue(share in 0.0015..0.01, "$share")
    }

    @Test
    fun normalNoiseHasNeither() {
        val random = Random(7)
        val noise = DoubleArray(n) { random.normal() }
        // One in two hundred of χ² with three degrees.
        assertTrue(Spikes.ratio(noise).ratio < 12.8 && Spikes.student(noise).ratio < 6.6)
    }

    /** Noise that wanders has little that comes anew with each row: a little with the heaviest tails is what outliers are. */
    @Test
    fun outliersAreFarLikelierThanTailsOfALittleOfTheNoise() {
        val random = Random(8)
        val keep = exp(-0.1)
        var wander = random.normal()
        val residuals = DoubleArray(n) {
            wander = keep * wander + sqrt(1 - keep * keep) * random.normal()
            wander
        }
        for (i in 50 until n step 100) residuals[i] += random.nextDouble(-7.0, 7.0)
        val noise = CorrelatedNoise(DoubleArray(n) { it.toDouble() }, 0.8, 10.0, BooleanArray(n) { true })
        val z = DoubleArray(n).also { noise.whiten(residuals, it) }
        val (outliers, tails) = Spikes.ratio(z).ratio to Spikes.student(z, noise).ratio
        assertTrue(outliers > tails + 50, "$outliers against $tails")
    }

    /** What wanders and is normal, and as much again with tails of four degrees, as a wandering noise leaves once whitened. */
    @Test
    fun tailsBesideNormalNoiseAreTails() {
        val random = java.util.Random(9)
        fun heavy() = random.nextGaussian() / sqrt(List(4) { random.nextGaussian() }.sumOf { it * it } / 4)
        val noise = DoubleArray(n) { sqrt(0.5) * (heavy() + random.nextGaussian()) }
        val apart = Spikes.student(noise, share = 0.5)
        assertTrue(apart.ratio > Spikes.student(noise).ratio, "$apart against ${Spikes.student(noise)}")
        val drawn = List(200_000) { sqrt(0.5) * (heavy() + random.nextGaussian()) }.count { abs(it) > 5 } / 200_000.0
        val foretold = TailedNoise(4, 0.5).beyond(5.0)
        assertTrue(foretold in drawn / 1.3..drawn * 1.3, "$foretold, drawn $drawn")
    }

    @Test
    fun theRowsBesideAWildOneAreNotWild() {
        val random = Random(8)
        val rows = DoubleArray(n) { 0.02 * random.normal() }
        rows[100] += 2.0
        assertEquals(listOf(100), (98..102).filter { Spikes.isSingle(rows, it) && abs(rows[it]) > 0.5 })
        assertFalse(Spikes.isSingle(rows, 99) || Spikes.isSingle(rows, 101))
    }
}
