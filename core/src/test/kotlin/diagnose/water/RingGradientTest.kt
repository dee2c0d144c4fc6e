package stillwater.diagnose.water

import stillwater.diagnose.CrossingTrack
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

class RingGradientTest {
    /** Beside each place of a way, another one so near, m, that the water between them is straight. */
    private val near = 0.02
    private val random = Random(SEED)
    private val way = CrossingTrack(300)
    private val angles = DoubleArray(300) { random.nextDouble(0.0, 2 * PI) }
    private val x = DoubleArray(600) { way.x[it / 2] + if (it % 2 == 0) 0.0 else near * cos(angles[it / 2]) }
    private val y = DoubleArray(600) { way.y[it / 2] + if (it % 2 == 0) 0.0 else near * sin(angles[it / 2]) }

    @Test
    fun theGradientIsHowTheWaterRisesInAnyDirection() {
        val rings = WaterRings(x, y, least = 6.0)
        val columns = rings.columns(DoubleArray(rings.size) { 1.0 / (it + 1) }, left = 1e-7, most = 600)
        val water = DoubleArray(600)
        for ((ring, column) in columns.all) {
            val height = random.nextDouble(-1.0, 1.0) / (ring + 1)
            for (i in water.indices) water[i] += height * column[i]
        }
        val (east, north) = columns.gradient.of(water)
        for (k in 0 until 300) {
            val rise = (water[2 * k + 1] - water[2 * k]) / near
            // In the middle between both: what is left is of the third order.
            val e = (east[2 * k] + east[2 * k + 1]) / 2
            val n = (north[2 * k] + north[2 * k + 1]) / 2
            assertEquals(rise, e * cos(angles[k]) + n * sin(angles[k]), 2e-3, "place $k, seed $SEED")
        }
    }

    private companion object {
        const val SEED = 71
    }
}
