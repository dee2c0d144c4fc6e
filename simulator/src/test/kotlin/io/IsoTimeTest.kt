package stillwater.io

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class IsoTimeTest {
    @Test
    fun aTimeWithAZoneWithAnOffsetAndWithNeitherAreTheSameMoment() {
        // date -u -d 2025-06-01T12:00:00Z +%s
        val noon = 1_748_779_200.0
        val texts =
            listOf("2025-06-01T12:00:00Z", "2025-06-01T08:00:00-04:00", "2025-06-01 12:00:00", " 2025-06-01T12:00 ")
        for (text in texts) assertEquals(noon, IsoTime.seconds(text), text)
        assertEquals(noon + 0.25, IsoTime.seconds("2025-06-01T12:00:00.25Z"), 1e-6)
    }

    @Test
    fun whatIsNoTimeIsNoNumber() {
        for (text in listOf("", "noon", "12:00:00", "2025-06-01", "2025-13-01T12:00:00Z", "2025-06-01X12:00:00Z")) {
            assertTrue(IsoTime.seconds(text).isNaN(), text)
        }
    }
}
