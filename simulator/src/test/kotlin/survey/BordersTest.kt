package stillwater.survey

import org.junit.jupiter.api.io.TempDir
import stillwater.io.LogChoice
import stillwater.io.SurveyLog
import stillwater.model.Interval
import stillwater.run.FilterKind
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.writeText
import kotlin.math.exp
import kotlin.math.floor
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.random.asJavaRandom
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Maps by filters that learn the sensor, of water that is even in cells of 10 m, between rows that are not at their borders. */
class BordersTest {
    @TempDir
    private lateinit var directory: Path

    private val cells = Random(7).let { random -> List(100) { 8 + random.nextDouble(-1.0, 1.0) } }

    private fun water(x: Double, y: Double): Double {
        fun place(along: Double) = floor(along / 10).toInt().coerceIn(0, 9)
        return cells[10 * place(y) + place(x)]
    }

    /** Ten legs east and west and ten north and south at 0.7 m/s, a row a second, fixes off by [jitter] m. */
    private fun log(seed: Int, jitter: Double): SurveyLog {
        val random = Random(seed)
        fun ends(leg: Int) = if (leg % 2 == 0) listOf(5.0, 95.0) else listOf(95.0, 5.0)
        val corners = (0..9).flatMap { leg -> ends(leg).map { it to 5 + 10.0 * leg } } +
            (0..9).flatMap { leg -> ends(leg + 1).map { 5 + 10.0 * leg to it } }
        val text = StringBuilder("time_s,x_m,y_m,v\n")
        var (x, y) = corners[0]
        var shown = water(x, y)
        var next = 1
        var part = 0
        while (next < corners.size) {
            shown += (water(x, y) - shown) * (1 - exp(-PART / LAG))
            if (part % 20 == 0) {
                fun off() = jitter * random.asJavaRandom().nextGaussian()
                val reading = shown + 0.05 * random.asJavaRandom().nextGaussian()
                text.appendLine(
                    String.format(Locale.ROOT, "%d,%.4f,%.4f,%.6f", part / 20, x + off(), y + off(), reading),
                )
            }
            part++
            val (toX, toY) = corners[next]
            val left = hypot(toX - x, toY - y)
            val share = minOf(SPEED * PART / left, 1.0)
            x += share * (toX - x)
            y += share * (toY - y)
            if (share == 1.0) next++
        }
        val file = directory.resolve("log.csv").also { it.writeText(text.toString()) }
        return SurveyLog.open(file, LogChoice(value = "v"))
    }

    private fun map(jitter: Double): SurveyMap {
        val settings = MapSettings(listOf(FilterKind.SELF_CALIBRATING), GridWish(cell = 10.0), Interval(6.5, 9.5))
        return SurveyMap.of(log(SEED, jitter), settings)
    }

    /** The share of the cells whose interval holds their water. */
    private fun held(map: SurveyMap): Double {
        val field = map.maps.getValue(FilterKind.SELF_CALIBRATING)
        val visited = field.visitedCells()
        val held = visited.count {
            val place = map.grid.center(it)
            water(place.x, place.y) in field.lower(it)..field.upper(it)
        }
        return held.toDouble() / visited.size
    }

    private fun assertLearned(jitter: Double, tolerance: Double) {
        val map = map(jitter)
        assertEquals(jitter, map.statistics.fixScatter, tolerance)
        val learned = checkNotNull(map.learned)
        assertTrue(learned.isExplained)
        val interval = learned.timeConstantInterval()
        assertTrue(LAG in interval.lower..interval.upper, "$interval")
        assertTrue(held(map) >= 0.9, "seed $SEED: ${held(map)}")
    }

    @Test
    fun theTimeOverABorderIsOfNeitherCell() = assertLearned(jitter = 0.0, tolerance = 1e-3)

    @Test
    fun readingsNearerToABorderThanFixesScatterAreOfNeither() = assertLearned(jitter = 0.4, tolerance = 0.04)

    private companion object {
        const val SEED = 5
        const val LAG = 10.0
        const val SPEED = 0.7

        /** Of a second. */
        const val PART = 0.05
    }
}
