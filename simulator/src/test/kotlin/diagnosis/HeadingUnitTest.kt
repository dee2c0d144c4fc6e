package stillwater.diagnosis

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.diagnose.Dependence
import stillwater.diagnose.Diagnosis
import stillwater.io.LogChoice
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Headings come in degrees from most loggers, by the compass; the diagnosis is to see the same in them. */
class HeadingUnitTest {
    @TempDir
    private lateinit var directory: Path

    private val random = Random(5)
    private val headings = DoubleArray(ROWS) { 0.9 * sin(it / 21.0) + (if (it / 60 % 2 == 0) 0.0 else PI) }

    /** A lag of 3 s, an offset that goes with the heading, and a little noise; the heading in three customs. */
    private val log: String by lazy {
        var state = 0.0
        buildString {
            appendLine("time_s,x_m,y_m,slow,fast,heading_rad,heading_deg,compass,yaw")
            for (i in 0 until ROWS) {
                val water = sin(i / 9.0) + sin(i / 4.1)
                state += (1 - exp(-1 / 3.0)) * (water - state)
                val read = state + 0.05 * cos(headings[i] - 1) + 0.005 * random.nextDouble()
                val east = Math.toDegrees(headings[i])
                append("$i,$i,${2 * sin(i / 30.0)},$read,$water,${headings[i]},$east,${(90 - east).mod(360.0)},")
                appendLine(headings[i])
            }
        }
    }

    private fun read(column: String) = SurveyLog.open(
        directory.resolve("log.csv").apply { writeText(log) },
        LogChoice(value = "slow", conditions = mapOf(DiagnosisLog.REFERENCE to "fast", Conditions.HEADING to column)),
    ).let { DiagnosisLog.of(it, mapOf(Conditions.HEADING to column), "fast") }

    private fun onHeading(column: String): Dependence =
        Diagnosis(read(column).series).run().dependences.single { it.description == "the heading" }

    @Test
    fun headingsAreRadiansForTheDiagnosis() {
        val radians = read("heading_rad").series.heading
        assertEquals(headings[70], radians[70])
        for (column in listOf("heading_deg", "yaw")) {
            val found = read(column).series.heading
            for (i in 0 until ROWS) assertEquals(headings[i], found[i], 1e-12, column)
        }
    }

    @Test
    fun compassDegreesShowWhatRadiansFromEastShow() {
        val east = onHeading("heading_rad")
        val compass = onHeading("compass")
        assertTrue(east.adjusted < 0.01, "$east")
        // Both customs' sines and cosines span the same columns; only the allowance for correlation, which is taken
        // column by column, differs a little.
        assertEquals(east.ratio, compass.ratio, 0.01 * east.ratio)
    }

    @Test
    fun unitIsToldByTheNameThenByTheNumbers() {
        val small = doubleArrayOf(0.0, 3.0, Double.NaN, 6.28)
        val large = doubleArrayOf(-7.0, 400.0)
        for (name in listOf("heading_deg", "Heading (deg)", "yaw °", "headingDeg", "HEADING DEGREES")) {
            assertTrue(HeadingUnit(name, small).inDegrees, name)
        }
        for (name in listOf("heading_rad", "yaw [rad]", "headingRad")) {
            assertFalse(HeadingUnit(name, large).inDegrees, name)
        }
        assertFalse(HeadingUnit("heading", small).inDegrees)
        assertTrue(HeadingUnit("heading", large).inDegrees)
        assertTrue(read("compass").heading!!.sentence.contains("compass were taken as degrees, for some are beyond"))
    }

    private companion object {
        const val ROWS = 600
    }
}
