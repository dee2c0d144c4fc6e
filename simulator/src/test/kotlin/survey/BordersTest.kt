package stillwater.survey

import org.junit.jupiter.api.io.TempDir
import stillwater.estimate.SensorKind
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
import kotlin.test.assertNull
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

    /** A sensor of [lag] s and [deadTime] s whose log has a row each [step] s and fixes off by [jitter] m. */
    private class Sensor(val lag: Double = 10.0, val deadTime: Int = 0, val step: Int = 1, val jitter: Double = 0.0)

    /** Ten legs east and west and ten north and south at 0.7 m/s. */
    private fun log(sensor: Sensor): SurveyLog {
        val random = Random(SEED)
        val seen = ArrayDeque<Double>()
        fun ends(leg: Int) = if (leg % 2 == 0) listOf(5.0, 95.0) else listOf(95.0, 5.0)
        val corners = (0..9).flatMap { leg -> ends(leg).map { it to 5 + 10.0 * leg } } +
            (0..9).flatMap { leg -> ends(leg + 1).map { 5 + 10.0 * leg to it } }
        val text = StringBuilder("time_s,x_m,y_m,v\n")
        var (x, y) = corners[0]
        var shown = water(x, y)
        var next = 1
        var part = 0
        while (next < corners.size) {
            seen += water(x, y)
            val late = if (seen.size > sensor.deadTime * PARTS) seen.removeFirst() else seen.first()
            shown += (late - shown) * (1 - exp(-PART / sensor.lag))
            if (part % (sensor.step * PARTS) == 0) {
                fun off() = sensor.jitter * random.asJavaRandom().nextGaussian()
                val reading = shown + 0.05 * random.asJavaRandom().nextGaussian()
                text.appendLine(
                    String.format(Locale.ROOT, "%d,%.4f,%.4f,%.6f", part / PARTS, x + off(), y + off(), reading),
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

    private fun map(sensor: Sensor, range: Interval? = Interval(6.5, 9.5)): SurveyMap {
        val settings = MapSettings(listOf(FilterKind.SELF_CALIBRATING), GridWish(cell = 10.0), range)
        return SurveyMap.of(log(sensor), settings)
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

    private fun assertLearned(map: SurveyMap, lag: Double = 10.0) {
        val learned = checkNotNull(map.learned)
        assertTrue(learned.isExplained)
        val interval = learned.timeConstantInterval()
        assertTrue(lag in interval.lower..interval.upper, "$interval")
        assertTrue(held(map) >= 0.9, "seed $SEED: ${held(map)}")
    }

    @Test
    fun whenTheBoatWasOverABorderIsKnownAsWellAsItsPlaces() {
        val map = map(Sensor())
        assertEquals(0.0, map.statistics.fixScatter, 1e-3)
        assertLearned(map)
    }

    @Test
    fun readingsNearerToABorderThanFixesScatterAreOfNeither() {
        val map = map(Sensor(jitter = 0.4))
        assertEquals(0.4, map.statistics.fixScatter, 0.04)
        assertLearned(map)
    }

    @Test
    fun aDeadTimeIsNoMultipleOfTheStepBetweenRows() {
        val map = map(Sensor(deadTime = 3, step = 2))
        assertLearned(map)
        val found = checkNotNull(map.learned).sensor().chosen
        assertEquals(SensorKind.DEAD_TIME, found.kind)
        val deadTime = found.parameters.single { it.name == "dead_time_s" }
        assertEquals(3.0, deadTime.value, 0.2)
        assertTrue(3.0 in deadTime.interval.lower..deadTime.interval.upper, "$deadTime")
    }

    @Test
    fun aLagLongerThanAStayShowsWaterBeyondTheReadings() {
        val map = map(Sensor(lag = 30.0), range = null)
        val readings = WaterRange.ofReadings(map.statistics)
        assertTrue(cells.max() > readings.upper || cells.min() < readings.lower, "$readings")
        assertTrue(map.isRangeWidened)
        assertTrue(map.prior.upper > cells.max() - 0.1 && map.prior.lower < cells.min() + 0.1, "${map.prior}")
        assertLearned(map, lag = 30.0)
    }

    @Test
    fun theRangeIsWidenedAsFarAsWhatIsKnownAndATenthMore() {
        val taken = Interval(2.0, 4.0)
        assertNull(WaterRange.wider(taken, null))
        assertNull(WaterRange.wider(taken, Interval(2.0, 4.0)))
        val wider = checkNotNull(WaterRange.wider(taken, Interval(2.5, 4.5)))
        assertEquals(2.0, wider.lower, 1e-12)
        assertEquals(4.7, wider.upper, 1e-12)
    }

    private companion object {
        const val SEED = 5
        const val SPEED = 0.7

        /** Of a second: the sensor of the log is ahead of one whose water changes all the time by half of this. */
        const val PART = 0.01
        const val PARTS = 100
    }
}
