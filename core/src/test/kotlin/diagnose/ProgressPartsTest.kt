package stillwater.diagnose

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class ProgressPartsTest {
    @Test
    fun eachPartGoesOnWhereTheOneBeforeItEnds() {
        val told = ArrayList<Double>()
        val parts = ProgressParts(told::add)
        for (share in listOf(0.6, 0.5, 1.0)) {
            val part = parts.next(share)
            listOf(0.0, 0.5, 1.0).forEach(part)
        }
        val expected = listOf(0.0, 0.3, 0.6, 0.6, 0.7, 0.8, 0.8, 0.9, 1.0)
        assertEquals(expected.size, told.size)
        expected.zip(told).forEach { (wanted, found) -> assertEquals(wanted, found, 1e-12) }
    }
}
