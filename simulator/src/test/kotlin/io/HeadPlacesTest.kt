package stillwater.io

import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull

class HeadPlacesTest {
    @TempDir
    private lateinit var directory: Path

    /** A log north along a meridian, whose first fixes are [wild] degrees off. */
    private fun log(vararg wild: Double): SurveyLog {
        val rows = (0 until 40).map { i ->
            String.format(Locale.ROOT, "%d,%.6f,-73.0,8.0", i, 45 + i * 1e-5 + wild.getOrElse(i) { 0.0 })
        }
        val file = directory.resolve("log.csv")
        file.writeText((listOf("time_s,lat_deg,lon_deg,do") + rows).joinToString("\n"))
        return SurveyLog.open(file, LogChoice(value = "do"))
    }

    @Test
    fun theFrameBeginsAfterWildFixes() {
        for (wild in listOf(doubleArrayOf(), doubleArrayOf(4.0), doubleArrayOf(-3.0, 5.0, -3.0))) {
            val log = log(*wild)
            val norths = ArrayList<Double>()
            log.read { _, _, y, _, _ -> norths += y }
            assertEquals(40 - wild.size, norths.size)
            assertEquals(45 + wild.size * 1e-5, assertNotNull(log.frame).origin.latitudeDeg, 1e-9)
            assertEquals(0.0, norths[0], 1e-6)
        }
    }
}
