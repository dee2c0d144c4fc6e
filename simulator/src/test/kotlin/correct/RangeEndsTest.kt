package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.Stillwater
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.readLines
import kotlin.io.path.writeText
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A given sensor whose range ends below the highest water, with noise and outliers behind the end. */
class RangeEndsTest {
    @TempDir
    private lateinit var directory: Path

    private val ends = listOf(SensorStage.Lag(8.0), SensorStage.Range(upper = END), SensorStage.Noise(0.02))

    private fun along(time: Double) = (time % 300).let { if (it < 150) it else 300 - it }

    private fun water(time: Double) = 8 + 2.2 * sin(along(time) / 22.0)

    /** What [stages] show at each row, the water between the rows included. */
    private fun shown(stages: List<SensorStage>, seed: Int): DoubleArray {
        val time = stages.filter { it is SensorStage.Lag }
        val lag = SensorSpec("lag", time).build(water(0.0), Random(seed))
        val rest = SensorSpec("rest", stages - time.toSet()).build(water(0.0), Random(seed))
        return DoubleArray(ROWS) { row ->
            var state = 0.0
            for (part in 1..10) state = lag.step(water(row - 1 + part / 10.0), 0.1, Conditions.NONE)
            rest.step(state, 1.0, Conditions.NONE)
        }
    }

    /** Ten legs of 150 m, there and back, at 1 m/s and 1 Hz. Seed fixed before the first run. */
    private fun log(stages: List<SensorStage>): Path {
        val rows = shown(stages, 611).mapIndexed { row, value ->
            String.format(Locale.ROOT, "%d,%.1f,%d,%.3f", row, along(row.toDouble()), row / 150 * 8, value)
        }
        return directory.resolve("log.csv").apply {
            writeText("time_s,x_m,y_m,do_mg_l\n" + rows.joinToString("\n", postfix = "\n"))
        }
    }

    private fun correct(stages: List<SensorStage>): CliktCommandTestResult {
        val file = directory.resolve("sensor.json").apply { writeText(SensorSpec("ends", stages).toJson()) }
        val arguments =
            listOf("correct", "${log(stages)}", "--value", "do_mg_l", "--sensor", "$file", "--out", "$directory/out")
        return Stillwater().subcommands(CorrectCommand()).test(arguments).also {
            assertEquals(0, it.statusCode, it.output)
        }
    }

    @Test
    fun rowsAtTheEndAreCountedAsOftenAsTheSensorWasThere() {
        val result = correct(ends)
        val states = shown(ends.take(1), 1)
        val isAtEnd = BooleanArray(ROWS) { states[it] > END }
        val said = checkNotNull(
            Regex(
                """(\d+) of 1500 readings are at the upper end of the sensor's range \(9\.845\)""",
            ).find(result.stderr),
        ) { result.stderr }.groupValues[1].toInt()
        // Rows just within it, by as much as noise may hide, are held to be at it. It was half of them.
        val least = (0.97 * isAtEnd.count { it }).toInt()
        assertTrue(said in least..states.count { it > END - 6 * 0.02 }, "$said, really ${isAtEnd.count { it }}")
        val rows = directory.resolve("out/corrected.csv").readLines().drop(1).map { it.split(',').takeLast(2) }
        val held = (0 until ROWS).filter { isAtEnd[it] }
            .count { water(it.toDouble()) in rows[it][0].toDouble()..rows[it][1].toDouble() }
        assertTrue(held >= 0.9 * isAtEnd.count { it }, "$held of ${isAtEnd.count { it }} rows at the end are held")
    }

    @Test
    fun theTerminalSaysInShortWhichRowsAreLessCertain() {
        val result = correct(ends + SensorStage.Outlying(0.01, 3.0))
        assertContains(
            result.stdout,
            Regex("""rows: 1500 corrected, \d+ at an end of the sensor's range, \d+ left out as outliers\n"""),
        )
        assertContains(
            result.stdout,
            Regex("""interval: 95 %, \S+ either way on average, \S+ within the sensor's range;"""),
        )
        assertContains(result.stderr, "Smaller ones that do not stand out count as noise and widen all intervals")
    }

    @Test
    fun noiseBehindTheEndScattersAboutIt() {
        fun within(vararg stages: SensorStage) = RangeEnds.beyondDoubt(SensorSpec("tried", stages.toList()))
        val ends = SensorStage.Range(0.0, 10.0)
        assertEquals(0.0..10.0, within(SensorStage.Noise(0.1), ends))
        assertEquals(0.75..9.25, within(ends, SensorStage.Noise(0.25)))
        assertEquals(1.5..18.5, within(ends, SensorStage.Noise(0.25), SensorStage.Calibration(2.0, 0.0)))
        // All of it might be noise.
        assertEquals(0.0..10.0, within(ends, SensorStage.Noise(4.0)))
    }

    private companion object {
        const val END = 9.845
        const val ROWS = 1500
    }
}
