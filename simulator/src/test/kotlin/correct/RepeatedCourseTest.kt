package stillwater.correct

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.util.Locale
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Courses that are sailed again and again the same way, where passes agree whatever the lag. */
class RepeatedCourseTest {
    @TempDir
    private lateinit var directory: Path
    private val logs by lazy { SlowLogs(directory) }

    /** What a sensor with a lag of 12 s shows along [place], once a second, in water of forty waves. */
    private fun log(rows: Int, place: (Double) -> Pair<Double, Double>) = buildString {
        appendLine("time_s,x_m,y_m,slow,truth")
        val random = java.util.Random(SEED)
        val waves = List(40) { k ->
            val scale = if (k < 30) 22.0 else 8.0
            val height = if (k < 30) 1.0 else 0.3
            listOf(random.nextGaussian() / scale, random.nextGaussian() / scale, 7 * random.nextDouble(), height)
        }
        fun water(x: Double, y: Double) = waves.sumOf { it[3] * cos(it[0] * x + it[1] * y + it[2]) } / sqrt(20.0)
        var shown = Double.NaN
        for (i in 0 until rows * FINE) {
            val (x, y) = place(i.toDouble() / FINE)
            val truth = water(x, y)
            shown = if (shown.isNaN()) truth else shown + (1 - exp(-1.0 / FINE / 12)) * (truth - shown)
            if (i % FINE != 0) continue
            fun off(by: Double) = by * random.nextGaussian()
            val numbers = listOf(i / FINE.toDouble(), x + off(0.15), y + off(0.15), shown + off(0.01), truth)
            appendLine(numbers.joinToString(",") { "%.4f".format(Locale.ROOT, it) })
        }
    }

    /** Still fewer than 95 % of the rows are held, 85; it was 69, and nothing was said. */
    @Test
    fun ofAFigureOfEightItsCrossingAloneTellsTheLag() {
        val result = logs.correct(log(2400) { 40 * sin(it / 74) to 25 * sin(it / 37) })
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "runs of the track all passes go the same way at the same speed")
        assertContains(result.stderr, "go the same way at the same speed, and agree whatever the sensor's lag, but in")
        assertTrue(logs.held() >= 0.8, "${logs.held()}")
    }

    /** Three responses were open, agreement with 100 runs was the check, and intervals held an eighth of the rows. */
    @Test
    fun orItDoesNotAndThatIsSaid() {
        val result = logs.correct(log(2400) { 55 * sin(it / 74) to 30 * sin(it / 37) })
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "agree whatever the sensor's lag, but in too few places, so that nothing shows")
        assertTrue(logs.held() >= 0.95, "${logs.held()}")
    }

    @Test
    fun ofARingNothingDoesAndThatIsSaid() {
        val result = logs.correct(log(2400) { 35 * sin(it / 48) to 35 * cos(it / 48) })
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "passes near each other go the same way at the same speed, and agree whatever")
        assertContains(result.stderr, "intervals hold a sensor with any lag of up to 30 s")
        assertTrue(logs.held() >= 0.95, "${logs.held()}")
    }

    private companion object {
        const val SEED = 6L
        const val FINE = 20
    }
}
