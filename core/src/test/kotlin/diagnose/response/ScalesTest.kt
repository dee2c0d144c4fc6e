package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import kotlin.test.Test
import kotlin.test.assertEquals

class ScalesTest {
    @Test
    fun theOrdinarySpeedOfABoatThatStandsMostOfTheTimeIsThatUnderWay() {
        fun ordinary(standing: Int): Double {
            val n = 100
            val speed = DoubleArray(n) { if (it < standing) 0.01 else 0.6 + 0.001 * it }
            val times = DoubleArray(n) { it.toDouble() }
            return Scales(MeasuredSeries(times, times, times, times, times, mapOf("speed" to speed))).ordinarySpeed
        }
        assertEquals(0.69, ordinary(standing = 80), 0.002)
        assertEquals(0.65, ordinary(standing = 0), 0.002)
    }
}
