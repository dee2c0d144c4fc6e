package stillwater.diagnose.response

import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals

class TruthChangesTest {
    @Test
    fun changesOfASineAreItsOwn() {
        val changes = TruthChanges(DoubleArray(4000) { sin(2 * PI * it / 40) })
        for (rows in intArrayOf(1, 7, 20)) {
            assertEquals(sqrt(2.0) * abs(sin(PI * rows / 40)), changes.over(rows.toDouble()), 1e-2, "$rows rows")
        }
    }

    @Test
    fun lessThanARowCountsInProportionAndNothingForNothing() {
        val changes = TruthChanges(DoubleArray(50) { 3.0 * it })
        assertEquals(1.5, changes.over(0.5), 1e-12)
        assertEquals(0.0, changes.over(0.0))
        assertEquals(0.0, TruthChanges(DoubleArray(0)).over(4.0))
    }
}
