package stillwater.diagnosis

import stillwater.model.Conditions
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals

/** What is written where there is no reading is told from what a probe may have read. */
class WrittenCodesTest {
    private val random = java.util.Random(5)
    private val water = DoubleArray(500) { 8 + sin(it / 20.0) + 0.01 * random.nextGaussian() }

    private fun with(code: Double, rows: Iterable<Int>) = water.copyOf().also { for (i in rows) it[i] = code }

    @Test
    fun numbersFarBeyondAllOthersThatComeAgainAreCodes() {
        assertEquals(listOf(99_999.0), WrittenCodes.of(with(99_999.0, 3..490 step 40)))
        assertEquals(listOf(-127.0), WrittenCodes.of(with(-127.0, listOf(7, 8, 9, 70))))
        val both = with(-127.0, 3..400 step 50).also { column -> for (i in 20..420 step 100) column[i] = 85.0 }
        assertEquals(listOf(-127.0, 85.0), WrittenCodes.of(both))
        // For as long as nobody heard the probe.
        assertEquals(listOf(9999.0), WrittenCodes.of(with(9999.0, 100..300)))
    }

    @Test
    fun singleNumbersAndThoseThatStayAreNone() {
        assertEquals(emptyList(), WrittenCodes.of(water))
        assertEquals(emptyList(), WrittenCodes.of(with(1e5, listOf(4, 90))))
        assertEquals(emptyList(), WrittenCodes.of(with(12.0, 3..490 step 40)), "within what water may be")
        assertEquals(emptyList(), WrittenCodes.of(with(150.0, 200..320)), "a sample that the probe was held into")
        assertEquals(emptyList(), WrittenCodes.of(with(9999.0, 100..400)), "most of the log")
        assertEquals(emptyList(), WrittenCodes.of(DoubleArray(40) { 8.0 }))
        assertEquals(emptyList(), WrittenCodes.of(DoubleArray(0)))
    }

    @Test
    fun whatTheReferenceHasTooIsReal() {
        val truth = with(150.0, 3..490 step 40)
        assertEquals(listOf(150.0), WrittenCodes.of(truth))
        assertEquals(emptyList(), WrittenCodes.of(truth, truth))
    }

    @Test
    fun rowsWithACodeInEitherColumnAreFound() {
        val log = LogColumns(emptyList())
        val values = with(-127.0, listOf(5, 50, 60))
        val truth = with(9999.0, listOf(60, 70, 80, 81))
        for (i in water.indices) {
            log.add(i.toDouble(), 0.0, 0.0, values[i], Conditions(mapOf(DiagnosisLog.REFERENCE to truth[i])))
        }
        val coded = CodedRows(log, "do", "truth")
        assertEquals(listOf(5, 50, 60, 70, 80, 81), water.indices.filter(coded::isIn))
        assertEquals(6, coded.rows)
        val left = "far beyond all others: taken for what is written where there is no number, and left out"
        assertEquals(
            listOf("the column do has -127 in 3 rows, $left", "the column truth has 9999 in 4 rows, $left"),
            coded.notes,
        )
    }
}
