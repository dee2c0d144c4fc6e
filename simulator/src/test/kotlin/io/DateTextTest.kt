package stillwater.io

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class DateTextTest {
    @Test
    fun minutesAndSecondsMayHaveOneDigitWhereThereAreSeconds() {
        // date -u -d 2014-08-07T22:06:04.5Z +%s
        assertEquals(1_407_449_164.5, DateText.seconds("2014-8-7 22:6:4.5", null))
        assertEquals(DateText.ofDay("08:05:09"), DateText.ofDay("8:5:9"))
        assertTrue(CellText.isTime("8:5:9") && CellText.isTime("2014-8-7 22:6:4.5"))
        // A ratio, or a scale, is no time of day.
        assertTrue(DateText.ofDay("8:5").isNaN() && !CellText.isTime("8:5"))
    }
}
