package stillwater.model

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertNull

class TypedPlaceTest {
    @Test
    fun degreesAreReadWithAPointOrAComma() {
        assertEquals(LatLon(45.5, -73.25), TypedPlace.of(" 45,5 ", "-73.25").place)
    }

    @Test
    fun whatIsNoPlaceIsSaidForEachNumber() {
        for (wrong in listOf("", "north", "91", "90", "NaN", "1e1", "4 5", "0x1", "1d")) {
            val typed = TypedPlace.of(wrong, "181")
            assertNull(typed.latitudeDeg, wrong)
            assertEquals(181.0, typed.longitudeDeg, "both customs of writing west occur")
            assertNull(typed.place)
        }
        assertNull(TypedPlace.of("45", "361").longitudeDeg)
    }
}
