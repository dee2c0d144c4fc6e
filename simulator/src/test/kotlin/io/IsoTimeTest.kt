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
    fun offsetsAreReadWithoutAColonAndInHours() {
        val noon = IsoTime.seconds("2025-06-01T12:00:00Z")
        val texts = listOf(
            "2025-06-01T14:00:00+02:00",
            "2025-06-01T14:00:00+0200",
            "2025-06-01 14:00:00+02",
            "2025-06-01T08:30:00.000-0330",
        )
        for (text in texts) assertEquals(noon, IsoTime.seconds(text), text)
        for (text in listOf("2025-06-01T14:00:00+2", "2025-06-01T14:00:00+02000", "2025-06-01T14:00:00+9900")) {
            assertTrue(IsoTime.seconds(text).isNaN(), text)
        }
    }

    @Test
    fun whereTimesHaveAnOffsetOneWithoutIsNone() {
        for (text in listOf("2025-06-01T12:00:00Z", "2025-06-01T12:00:00+02", "2025-06-01T12:00:00+02:00")) {
            assertEquals(true, IsoTime.isZoned(text), text)
            assertEquals(IsoTime.seconds(text), IsoTime.seconds(text, isZoned = true), text)
            assertTrue(IsoTime.seconds(text, isZoned = false).isNaN(), text)
        }
        val naive = "2025-06-01T12:00:00"
        assertEquals(false, IsoTime.isZoned(naive))
        assertEquals(IsoTime.seconds(naive), IsoTime.seconds(naive, isZoned = false))
        assertTrue(IsoTime.seconds(naive, isZoned = true).isNaN())
        assertEquals(null, IsoTime.isZoned("noon"))
    }

    @Test
    fun whatIsNoTimeIsNoNumber() {
        for (text in listOf("", "noon", "12:00:00", "2025-06-01", "2025-13-01T12:00:00Z", "2025-06-01X12:00:00Z")) {
            assertTrue(IsoTime.seconds(text).isNaN(), text)
        }
    }
}
