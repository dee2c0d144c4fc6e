package stillwater.model

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class ConditionsTest {
    @Test
    fun givesWhatWasMeasuredAndNaNForTheRest() {
        val conditions = Conditions(mapOf(Conditions.SPEED to 1.2, "turbidity" to 40.0))
        assertEquals(1.2, conditions[Conditions.SPEED], 0.0)
        assertEquals(40.0, conditions["turbidity"], 0.0)
        assertTrue(conditions[Conditions.HEADING].isNaN())
        assertTrue(Conditions.NONE[Conditions.SPEED].isNaN())
        assertEquals(setOf("speed", "turbidity"), conditions.names)
        assertEquals(emptySet(), Conditions.NONE.names)
    }

    @Test
    fun doesNotChangeWithTheMapItWasMadeOf() {
        val source = mutableMapOf(Conditions.SPEED to 1.0)
        val conditions = Conditions(source)
        source[Conditions.SPEED] = 2.0
        source[Conditions.TEMPERATURE] = 20.0
        assertEquals(1.0, conditions[Conditions.SPEED], 0.0)
        assertEquals(setOf(Conditions.SPEED), conditions.names)
    }

    @Test
    fun equalsByContent() {
        val one = Conditions(mapOf("a" to 1.0, "b" to Double.NaN))
        val same = Conditions(mapOf("b" to Double.NaN, "a" to 1.0))
        assertEquals(one, same)
        assertEquals(one.hashCode(), same.hashCode())
        assertNotEquals(one, Conditions(mapOf("a" to 1.0)))
        assertEquals(Conditions.NONE, Conditions(emptyMap()))
        assertEquals("Conditions({a=1.0, b=NaN})", one.toString())
    }

    @Test
    fun aReadingWithoutConditionsHasNone() {
        assertEquals(Conditions.NONE, Reading(BoatTime(0.0), Position(0.0, 0.0), 1.0).conditions)
    }
}
