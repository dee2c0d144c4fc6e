package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.Stillwater
import stillwater.model.Conditions
import stillwater.sensor.SensorModel
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.exp
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** What `correct` does not know, it says. */
class CorrectHonestyTest {
    @TempDir
    private lateinit var directory: Path

    private fun correct(text: String, vararg flags: String): CliktCommandTestResult {
        val log = directory.resolve("log.csv").also { it.writeText(text) }
        val out = directory.resolve("results").toString()
        val arguments = listOf("correct", log.toString(), "--value", "slow", "--out", out) + flags
        return Stillwater().subcommands(CorrectCommand()).test(arguments)
    }

    private fun water(x: Double, y: Double) = sin(x / 6) + 0.7 * sin(y / 7 + x / 15)

    /** A boat that mows a pond of 60 m by 60 m at 1 m/s; a lag of 6 s; a reference in some rows. */
    private fun pond(rows: Int, referenceEvery: Int) = buildString {
        appendLine("time_s,x_m,y_m,slow,fast")
        var shown = water(0.0, 0.0)
        for (i in 0 until rows) {
            val along = Math.floorMod(i, 120).let { if (it < 60) it.toDouble() else 120.0 - it }
            val across = (i / 60 * 6 % 66).toDouble()
            val (x, y) = along to across
            shown += (1 - exp(-1.0 / 6)) * (water(x, y) - shown)
            val fast = if (i % referenceEvery == 0) "%.4f".format(Locale.ROOT, water(x, y)) else ""
            appendLine("$i,$x,$y,${"%.4f".format(Locale.ROOT, shown)},$fast")
        }
    }

    /** Water that rises evenly from 8, and a reference that does from [reference]. */
    private fun ramp(rows: Int, reference: Double) = "time_s,x_m,y_m,slow,fast\n" + (0 until rows).joinToString("") {
        "$it,$it,0,${8 + 0.002 * it + 0.004 * (it * 7 % 5)},${reference + 0.002 * it + 0.004 * (it * 3 % 7)}\n"
    }

    @Test
    fun thirtyRowsTeachNothing() {
        val result = correct(ramp(30, reference = 8.05), "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "sensor: not learned")
        assertContains(result.stderr, "its 30 rows, 29 s long, fit any lag from ")
    }

    /** The first reading tells only where the sensor began, so that 29 are left. */
    @Test
    fun aClearLagInThirtyRowsIsNoError() {
        var shown = 0.0
        val log = "time_s,slow,fast\n" + (0 until 30).joinToString("") { i ->
            val water = 3 * sin(i / 2.5)
            shown += (1 - exp(-1.0 / 3)) * (water - shown)
            "$i,${"%.3f,%.3f".format(Locale.ROOT, shown, water)}\n"
        }
        val result = correct(log, "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "its 30 rows are too few; nothing was learned")
    }

    /** Waves shorter than both lags: a single lag would fit as an integrator, and so at any length. */
    @Test
    fun twoLagsAreLearnedWhereASingleOneCouldBeOfAnyLength() {
        fun water(t: Double) = List(6) { sin(t / (4.0 + 2 * it) + it) }.sum()
        val random = java.util.Random(5)
        var first = water(0.0)
        var second = first
        val log = buildString {
            appendLine("time_s,slow,fast")
            for (i in 0 until 600) {
                repeat(20) { part ->
                    first += (1 - exp(-0.05 / 12.6)) * (water(i - 1 + (part + 0.5) / 20) - first)
                    second += (1 - exp(-0.05 / 10.8)) * (first - second)
                }
                val shown = second + 0.05 * random.nextGaussian()
                appendLine("$i,${"%.4f,%.4f".format(Locale.ROOT, shown, water(i.toDouble()))}")
            }
        }
        val result = correct(log, "--reference", "fast")
        assertContains(result.stdout, "second-order-lag")
        assertFalse("nothing was learned" in result.stderr, result.stderr)
    }

    @Test
    fun aReferenceThatTeachesNothingStillWidensIntervalsThatItContradicts() {
        val result = correct(ramp(200, reference = 8.5), "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "nothing was learned")
        assertContains(result.stderr, "give --sensor\n")
        assertContains(result.stderr, "the reference lies outside the intervals in 100.0 % of 200 rows")
        val half = assertNotNull(Regex("""reach ([\d.]+) either""").find(result.stdout)).groupValues[1].toDouble()
        assertTrue(half > 0.5, result.stdout)
    }

    /** Opposite legs of a stuck sensor differ by rounding, of which there is no share. */
    @Test
    fun aStuckSensorIsNotCalledAnotherSensor() {
        val stuck = pond(600, referenceEvery = 1).lines().filter { it.isNotEmpty() }.mapIndexed { i, line ->
            val cells = line.split(',')
            if (i == 0) line else "${cells[0]},${cells[1]},${cells[2]},8.1,8.1"
        }
        val result = correct(stuck.joinToString("\n"))
        assertContains(result.stderr, "the readings never change")
        assertFalse("opposite legs differ" in result.stderr, result.stderr)
    }

    @Test
    fun fewLegsAreSaidToBeTooFew() {
        val few = correct(pond(400, referenceEvery = 1), "--reference", "fast")
        assertContains(few.stdout, "; too few legs to tell, 5\n")
        // A share would be read as a judgement all the same.
        assertFalse("than measured" in few.stdout, few.stdout)
    }

    /** Legs as measured are taken in the unit of the reference too, or they would differ by 1.8 times as much. */
    @Test
    fun aReferenceInAnotherUnitIsSaid() {
        fun differ(text: String): Pair<String, CliktCommandTestResult> {
            val result = correct(text, "--reference", "fast")
            val measured = Regex("""legs: differ by (\S+) as measured""").find(result.stdout)
            return assertNotNull(measured).groupValues[1] to result
        }
        val celsius = pond(700, referenceEvery = 1)
        val fahrenheit = celsius.lines().filter { it.isNotEmpty() }.map { line ->
            val reference = line.substringAfterLast(',').toDoubleOrNull()
            val other = reference?.let { "%.4f".format(Locale.ROOT, 32 + 1.8 * it) } ?: "fast"
            "${line.substringBeforeLast(',')},$other"
        }.joinToString("\n")
        val (same, plain) = differ(celsius)
        val (other, told) = differ(fahrenheit)
        assertFalse("in the reference's unit" in plain.stderr, plain.stderr)
        assertContains(told.stderr, "the readings are 0.556 times the reference plus -17.8: the corrected")
        assertEquals(1.8 * same.toDouble(), other.toDouble(), 0.01 * other.toDouble())
    }

    @Test
    fun aNarrowIntervalHasTwoEnds() {
        val result = correct(pond(700, referenceEvery = 1), "--reference", "fast")
        assertFalse("too few legs" in result.stdout, result.stdout)
        val ends = Regex("""time constant in s \S+ \((\S+) to (\S+)\)""").find(result.stdout)?.groupValues.orEmpty()
        assertEquals(3, ends.size, result.stdout)
        assertTrue(ends[1] < ends[2], result.stdout)
        // Nobody looked for what a reference shows better.
        val summary = directory.resolve("results/summary.json").readText()
        assertContains(summary, "\"unevenness_s\": null")
        assertFalse("still_probability" in summary, summary)
    }

    @Test
    fun optionsThatWouldChangeNothingAreRefused() {
        val alone = correct(pond(60, referenceEvery = 1), "--condition", "temperature=fast")
        assertEquals(2, alone.statusCode)
        assertContains(alone.stderr, "--condition: expected --sensor to go with it, found none")
        val known = correct(pond(60, referenceEvery = 1), "--reference", "fast", "--held-out")
        assertEquals(2, known.statusCode)
        assertContains(known.stderr, "--held-out: expected a sensor learned from passes through the same water, found")
    }

    @Test
    fun theAnswerComesBeforeAllElse() {
        val result = correct(pond(700, referenceEvery = 1))
        val answer = result.stdout.lines().first()
        assertTrue(answer.startsWith("The readings trail the water by "), answer)
        val delay = answer.removePrefix("The readings trail the water by ").substringBefore(" s").toDouble()
        // Kinds of response that rows a second apart do not tell apart differ by a second or two.
        assertTrue(delay in 4.0..7.0, answer)
        assertContains(answer, "Passes in opposite directions then disagree by ")
        val page = directory.resolve("results/report.html").readText()
        assertContains(page, Regex("<main><p class=\"answer\">The readings trail .*?</p><div class=\"warnings\""))
        val still =
            correct(
                pond(60, referenceEvery = 1).lines().joinToString("\n") { it.replace(Regex(",.*?,.*?,"), ",0,0,") }
                    .replaceFirst("time_s,0,0,", "time_s,x_m,y_m,"),
            )
        assertContains(still.stdout, "Nothing in this log shows how the sensor responds")
    }

    /** A sensor that was switched on late, that was not heard for three rows, and one digit that was lost. */
    @Test
    fun numbersThatAreNoReadingsChangeNothing() {
        fun interval(result: CliktCommandTestResult) =
            result.stdout.substringAfter("interval: 95 %, ").substringBefore(' ').toDouble()
        val rows = pond(700, referenceEvery = 1).trimEnd().lines()
        val clean = correct(rows.joinToString("\n"))
        val codes = mapOf(1 to "9999", 100 to "65535", 101 to "65535", 102 to "65535", 350 to "-40")
        val result = correct(
            rows.mapIndexed { i, row ->
                val cells = row.split(',')
                codes[i]?.let { (cells.take(3) + it + cells.drop(4)).joinToString(",") } ?: row
            }.joinToString("\n"),
        )
        assertContains(result.stderr, "stand out from those around them")
        fun lag(result: CliktCommandTestResult) =
            result.stdout.substringAfter("The readings trail the water by ").substringBefore(" s").toDouble()
        assertEquals(lag(clean), lag(result), 0.1)
        fun legs(result: CliktCommandTestResult) =
            result.stdout.substringAfter("opposite legs: differ by ").substringBefore(" as").toDouble()
        assertEquals(legs(clean), legs(result), 0.02 * legs(clean))
        // Five rows of 700 say nothing any more, and those near them less.
        assertEquals(interval(clean), interval(result), 0.2 * interval(clean))
    }

    /** The fixes of a boat at anchor wander over water that changes with time: that is no lag. */
    @Test
    fun aBoatAtAnchorTeachesNothing() {
        val random = Random(7)
        var north = 0.0
        var east = 0.0
        val rows = (0 until 1000).joinToString("") {
            north += -0.01 * north + 0.1 * (random.nextDouble() - 0.5)
            east += -0.01 * east + 0.1 * (random.nextDouble() - 0.5)
            val value = "%.3f".format(Locale.ROOT, 12 + 0.5 * sin(it / 100.0) + 0.01 * random.nextDouble())
            "$it,${45 + north / 111_195},${-73 + east / 78_627},$value\n"
        }
        val result = correct("time_s,lat_deg,lon_deg,slow\n$rows")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "sensor: not learned")
        assertContains(result.stderr, "the boat hardly moves: 95 % of its fixes lie within 5 m")
        assertFalse("passes through the same" in result.stderr, result.stderr)
        val half = Regex("interval: 95 %, ([0-9.]+) either way").find(result.stdout)!!.groupValues[1].toDouble()
        assertTrue(half < 0.05, "$half")
    }

    /** Once out and once back are too few passes to learn on; that they disagree is told all the same. */
    @Test
    fun passesTooFewToLearnOnStillWidenTheIntervals() {
        val rows = (0 until 80).joinToString("") {
            val x = if (it < 40) it.toDouble() else 79.5 - it
            val value = "%.3f".format(Locale.ROOT, sin(x / 6) + (if (it < 40) 0.0 else 0.4) + 0.002 * (it * 7 % 5))
            "$it,$x,${0.1 * (it % 2)},$value\n"
        }
        val result = correct("time_s,x_m,y_m,slow\n$rows")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "sensor: not learned")
        assertContains(result.stderr, "too few passes come near another")
        assertContains(result.stderr, "passes through the same")
        assertContains(result.stdout, "if the sensor has no lag, widened by what passes disagree in")
        val half = Regex("interval: 95 %, ([0-9.]+) either way").find(result.stdout)!!.groupValues[1].toDouble()
        assertTrue(half > 0.1, "$half")
    }

    @Test
    fun aReferenceNowAndThenIsNotTakenForTheWaterBetween() {
        val result = correct(pond(600, referenceEvery = 15), "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "it has a row every 15 s only")
        assertContains(result.stderr, "learned from passes through the same water instead")
        // Legs beside each other never cross.
        assertContains(result.stdout, "not checked, for the boat's track nowhere crosses itself")
    }

    /** Legs of 80 m over water of many lengths at 1 m/s, as [sensor] shows it, stepped ten times a second. */
    private fun legs(sensor: SensorModel, truths: MutableList<Double>? = null): String {
        val random = Random(17)
        val waves = List(40) { List(3) { random.nextDouble(-1.0, 1.0) } }
        fun at(time: Double): Pair<Double, Double> {
            val leg = (time / 86).toInt()
            val along = time % 86
            val up = minOf(along, 80.0)
            return (if (leg % 2 == 0) up else 80 - up) to 6 * leg + maxOf(0.0, along - 80)
        }
        fun water(time: Double) = at(time).let { (x, y) ->
            waves.sumOf { (a, b, c) ->
                0.2 *
                    sin((a * x + b * y) / 8 + 3 * c)
            }
        }
        return (0 until 1600).joinToString("", prefix = "time_s,x_m,y_m,slow\n") { row ->
            var shown = 0.0
            for (part in 1..10) shown = sensor.step(water(row + part / 10.0), 0.1, Conditions.NONE)
            val (x, y) = at(row + 1.0)
            truths?.add(water(row + 1.0))
            val value = shown + 0.01 * random.nextDouble()
            "%d,%.2f,%.2f,%.3f\n".format(Locale.ROOT, row + 1, x, y, value)
        }
    }

    @Test
    @Tag("long")
    fun aLagBeforeARateLimitIsLearnedAndInTheIntervals() {
        val stages = listOf(SensorStage.Lag(4.0), SensorStage.Slew(0.08))
        val truths = ArrayList<Double>()
        val result = correct(legs(SensorSpec("limited", stages).build(0.0, Random(1)), truths))
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "sensor: slew-limit: rate per s 0.0798; before it: ")
        assertContains(result.stdout, "first-order-lag: time constant in s ")
        val rows = directory.resolve("results/corrected.csv").readLines().drop(1).map { it.split(',') }
        val held = rows.indices.count { truths[it] in rows[it][5].toDouble()..rows[it][6].toDouble() }
        // With the rate alone undone they hold a third of them.
        assertTrue(held > 0.85 * rows.size, "${held.toDouble() / rows.size}")
    }

    /** A dead time between 2 and 12 s, and no crossing that would show it. */
    @Test
    @Tag("long")
    fun aDelayThatChangesAlongTheTrackIsWarnedOf() {
        val inputs = ArrayList<Double>()
        val late = SensorModel { truth, _, _ ->
            inputs += truth
            inputs[maxOf(0, inputs.size - 1 - (70 + 50 * sin(inputs.size / 600.0)).toInt())]
        }
        val result = correct(legs(late))
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "here by more and there by less")
        assertContains(result.stdout, "widened by how unevenly late passes beside each other are")
        val summary = directory.resolve("results/summary.json").readText()
        assertFalse("\"unevenness_s\": null" in summary, summary)
        assertContains(summary, "\"still_probability\": ")
        assertContains(result.stderr, "a sensor whose zero wanders")
    }

    /** Of 33 rows with a reference five are at an end of the range, and say nothing of the response. */
    @Test
    fun readingsAtAnEndOfTheRangeAreNotCounted() {
        val rows = (0 until 33).joinToString("") {
            "$it,$it,0,${if (it in 20..24) 9.5 else 8 + 0.02 * it + 0.004 * (it * 7 % 5)},${8 + 0.02 * it}\n"
        }
        val result = correct("time_s,x_m,y_m,slow,fast\n$rows", "--reference", "fast")
        assertEquals(2, result.statusCode, result.output)
        assertContains(result.stderr, "at least 30 readings with a reference that are neither wild nor at an end")
        assertContains(result.stderr, "found 28")
    }

    @Test
    fun timesShorterThanRowsCanShowAreNone() {
        val result = correct(pond(500, referenceEvery = 1), "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        val sensor = result.stdout.lines().first { it.startsWith("sensor:") }
        assertFalse(Regex("dead time in s 0\\.0").containsMatchIn(sensor), sensor)
        assertContains(result.stdout, "log: log.csv (survey CSV)")
    }
}
