package stillwater.survey

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNull
import kotlin.test.assertTrue

class GapsTest {
    @Test
    fun findsTheLongestGapAndTheJumpOverIt() {
        val gaps = Gaps(limit = 5.0)
        for (i in 0 until 10) gaps.add(100.0 + i, i.toDouble(), 0.0)
        gaps.add(120.0, 9.0, 0.0)
        gaps.add(3120.0, 12.0, 4.0)
        gaps.add(3121.0, 12.0, 4.0)
        assertEquals(2, gaps.count)
        assertEquals(Gap(start = 20.0, seconds = 3000.0, jump = 5.0), gaps.longest)
        assertTrue(gaps.between(109.0, 120.0))
        assertTrue(gaps.between(105.0, 3121.0), "also between thinned points")
        assertFalse(gaps.between(100.0, 109.0))
        assertFalse(gaps.between(3120.0, 3121.0))
    }

    @Test
    fun aSteadyLogHasNone() {
        val gaps = Gaps(limit = 5.0)
        for (i in 0 until 10) gaps.add(5.0 * i, 0.0, 0.0)
        assertEquals(0, gaps.count)
        assertNull(gaps.longest)
        assertFalse(gaps.between(0.0, 45.0))
    }
}
