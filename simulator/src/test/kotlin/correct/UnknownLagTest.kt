package stillwater.correct

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.readText
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Intervals of logs that hold no evidence on their sensor, and of a slow boat that once was such a log. */
class UnknownLagTest {
    @TempDir
    private lateinit var directory: Path
    private val logs by lazy { SlowLogs(directory) }

    /** What a sensor with a lag of 8 s shows of [water] five times a second at [place], with fixes off by [off], m, each. */
    private fun log(
        rows: Int,
        off: Double,
        place: (Double) -> Pair<Double, Double>,
        water: (Double, Double, Double) -> Double,
    ) = buildString {
        appendLine("time_s,x_m,y_m,slow,truth")
        val random = java.util.Random(3)
        var shown = Double.NaN
        for (i in 0 until rows) {
            val time = i / 5.0
            val (x, y) = place(time)
            val truth = water(x, y, time)
            shown = if (shown.isNaN()) truth else shown + (1 - exp(-1.0 / 40)) * (truth - shown)
            val numbers = listOf(
                time,
                x + off * random.nextGaussian(),
                y + off * random.nextGaussian(),
                shown + 0.005 * random.nextGaussian(),
                truth,
            )
            appendLine(numbers.joinToString(",") { "%.3f".format(Locale.ROOT, it) })
        }
    }

    /** Its intervals held 2 to 4 % of the rows, "because the boat hardly moves". */
    @Test
    fun aSlowBoatWhoseFixesScatterFartherThanItGoesInTenSecondsIsLearnedFrom() {
        // To and fro at 0.5 m/s on legs of 40 m, 5 m apart.
        fun place(time: Double): Pair<Double, Double> {
            val leg = (time / 80).toInt()
            val along = time * 0.5 - leg * 40
            return (if (leg % 2 == 0) along else 40 - along) to 5.0 * leg
        }
        val result = logs.correct(log(4800, off = 1.8, ::place) { x, y, _ -> sin(x / 7 + 1) + sin(y / 9 + x / 30) })
        assertEquals(0, result.statusCode, result.output)
        assertFalse("hardly moves" in result.stderr, result.stderr)
        assertContains(result.stdout, "runs of the track foretold by other passes")
        assertTrue(logs.held() >= 0.95, "${logs.held()}")
    }

    /** They held a tenth of the rows and less. */
    @Test
    fun intervalsOfABoatAtAnchorHoldALagOfWhichNothingIsKnown() {
        fun place(time: Double) = 5 * sin(time / 50) to 5 * cos(time / 70)
        val result = logs.correct(log(3000, off = 1.6, ::place) { x, _, time -> 0.02 * x + 0.3 * sin(time / 60) })
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "hardly moves")
        assertContains(
            result.stderr,
            "intervals hold a sensor with any lag of up to 30 s, no slower one; without lag they are 0.00",
        )
        assertContains(result.stdout, "if the sensor has no lag; as written, for any lag of up to 30 s, 0.")
        assertContains(directory.resolve("results/summary.json").readText(), "\"mean_half_width_without_lag\": 0.00")
        assertTrue(logs.held() >= 0.95, "${logs.held()}")
    }

    /** A way out that is not come back. */
    @Test
    fun soDoThoseOfATrackThatNeverComesBack() {
        fun place(time: Double) = time to 3 * sin(time / 30)
        val result = logs.correct(log(2500, off = 0.2, ::place) { x, y, _ -> sin(x / 12) + y / 10 })
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "no pass comes near another")
        assertTrue(logs.held() >= 0.95, "${logs.held()}")
    }
}
