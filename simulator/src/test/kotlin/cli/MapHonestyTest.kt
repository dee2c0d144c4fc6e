package stillwater.cli

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import kotlinx.serialization.json.long
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.sin
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What was not measured is not shown as measured, and what may mislead is said. */
class MapHonestyTest {
    @TempDir
    private lateinit var directory: Path

    private fun log(text: String): String = directory.resolve("survey.csv").apply { writeText(text) }.toString()

    private fun json(text: String, vararg flags: String): JsonObject {
        val result = runMap(log(text), "--out", directory.out().toString(), "--json", *flags)
        assertEquals(0, result.statusCode, result.output)
        return Json.parseToJsonElement(result.stdout).jsonObject
    }

    private fun JsonObject.child(name: String) = getValue(name).jsonObject

    private fun JsonObject.warnings() = getValue("warnings").jsonArray.map { it.jsonPrimitive.content }

    private fun report() = directory.out().resolve("report.html").readText()

    /** A cell of 10 m in which readings rise from [first] by 0.95, and on the way back fall from [second] by as much. */
    private fun thereAndBack(first: Double, second: Double) = buildString {
        appendLine("time_s,x_m,y_m,v")
        for (i in 0 until 20) appendLine("$i,${0.4 * i},1,${first + 0.05 * i}")
        // Another cell, too short for any bound; leaving the first one keeps the turn from being a slope there.
        for (i in 20 until 23) appendLine("$i,15,1,8.5")
        for (i in 23 until 43) appendLine("$i,${0.4 * (42 - i)},1,${second - 0.05 * (i - 23)}")
    }

    private val flags = arrayOf("--cell", "10", "--epsilon", "0.01", "--range", "0:20")

    @Test
    fun theRangeTakenForTheWaterHasNoMoreDigitsThanItMeans() {
        json(thereAndBack(8.0, 9.1), "--cell", "10", "--epsilon", "0.01")
        val range = Regex("range taken for the water, (\\S+) to (\\S+)\\. Cells").find(report())?.groupValues.orEmpty()
        assertEquals(listOf("7.89", "9.21"), range.drop(1))
    }

    /** A logger's code in one row of 40 is in more rows than the hundredth that a wild reading or two are in. */
    @Test
    fun codesThatAreNoReadingsAreTold() {
        fun warnings(every: Int, vararg flags: String): List<String> {
            val rows = smallSurvey(400).trimEnd().lines().mapIndexed { i, row ->
                if (i > 0 && i % every == 0) row.substringBeforeLast(',') + ",9999" else row
            }
            return json(rows.joinToString("\n"), *flags).warnings().filter { "% lie within" in it }
        }
        assertEquals(emptyList(), warnings(1000))
        assertContains(warnings(399).single(), "to 9999 but 98 % lie within 8")
        assertContains(warnings(40).single(), "to 9999 but 90 % lie within 8")
        val both = "those beyond are in the means of their cells and set the range of the bounded filter; give --range"
        assertContains(warnings(40).single(), both)
        assertTrue(warnings(40, "--filter", "bounded", "--range", "7:10").single().last().isDigit())
    }

    @Test
    fun countsCrossedBoundsApartAndWarns() {
        // Rising to 8.95, falling to 8.05: the lower bound ends above the upper one.
        val summary = json(thereAndBack(8.0, 9.0), *flags)
        val cells = summary.child("filters").child("bounded").child("visited_cells")
        assertEquals(
            listOf(0L, 1L, 0L, 1L),
            listOf("both", "crossed", "one-sided", "none").map {
                cells.getValue(it).jsonPrimitive.long
            },
        )
        assertContains(
            summary.warnings().joinToString("\n"),
            "the bounds crossed (lower above upper) in 1 of 2 visited",
        )
        val statuses = directory.out().resolve("cells.csv").readLines().map { it.split(',').last() }
        assertEquals(listOf("status", "measured", "measured", "crossed", "none"), statuses)
        assertContains(directory.out().resolve("bounds-width.svg").readText(), "crossed: 1, without width")
        assertContains(directory.out().resolve("estimate-bounded.svg").readText(), "crossed: 1 of 2 cells")
        assertFalse("crossed" in directory.out().resolve("estimate-averaging.svg").readText())
    }

    @Test
    fun crossedBoundsOfATransectAreNoBand() {
        fun figure(first: Double, second: Double): String {
            json(thereAndBack(first, second).replace(",1,", ",").replace("y_m,", ""), "--x", "x_m", *flags)
            return directory.out().resolve("estimate-bounded.svg").readText()
        }
        val bands = Regex("<path[^>]* fill=\"rgb\\(0,114,178\\)\"")
        val crossed = figure(8.0, 9.0)
        assertContains(crossed, "crossed: 1 of 2 cells")
        assertContains(crossed, ">crossed<")
        assertFalse("both bounds" in crossed || bands.containsMatchIn(crossed))
        val ordered = figure(7.0, 9.5)
        assertContains(ordered, ">both bounds<")
        assertFalse("crossed" in ordered)
        assertEquals(1, bands.findAll(ordered).count())
    }

    @Test
    fun boundsInOrderAreNoCauseToWarn() {
        val summary = json(thereAndBack(7.0, 9.5), *flags)
        val cells = summary.child("filters").child("bounded").child("visited_cells")
        assertEquals(1, cells.getValue("both").jsonPrimitive.long)
        assertFalse(summary.warnings().any { "crossed (lower" in it })
        assertContains(directory.out().resolve("bounds-width.svg").readText(), "width of v")
        assertContains(report(), "of 2 visited cells 1 have both bounds")
    }

    @Test
    fun aBoatThatDoesNotGoAnywhereIsTold() {
        fun warnings(step: Double) = json(
            "time_s,x_m,y_m,v\n" + (0 until 60).joinToString("") { "$it,${step * it},1,${8 + it % 5}\n" },
        ).warnings()
        assertContains(warnings(0.0), "the boat never moved: the map is of one place")
        assertTrue(warnings(0.001).any { "the boat hardly moved (median speed 0.001 m/s)" in it })
        assertFalse(warnings(0.5).any { "moved" in it })
    }

    @Test
    fun oneJumpAndOneFurtherGapAreOne() {
        fun warnings(jumps: Int, gaps: Int) = json(
            "time_s,x_m,y_m,v\n" + (0 until 200).joinToString("") { i ->
                "${i + 300 * minOf(i / 50, gaps)},${i + 500 * minOf(i / 60, jumps)},1,${8 + i % 5}\n"
            },
        ).warnings().joinToString("\n")
        assertContains(warnings(jumps = 1, gaps = 2), "1 jump in the positions is faster than 20 m/s")
        assertContains(warnings(jumps = 2, gaps = 3), "2 jumps in the positions are faster than 20 m/s")
        assertContains(warnings(jumps = 0, gaps = 2), "; 1 more gap is shorter")
        assertContains(warnings(jumps = 0, gaps = 3), "; 2 more gaps are shorter")
    }

    @Test
    fun intervalFilterSaysWhatItsBoundsAssume() {
        val summary = json(smallSurvey(), "--filter", "interval", "--unit", "mg/L")
        val assumed = summary.child("interval_assumes").mapValues { it.value.jsonPrimitive.content }
        assertEquals("60.0" to "false", assumed["longest_time_constant_s"] to assumed["longest_time_constant_given"])
        assertEquals("0.002" to "resolution", assumed["reading_error"] to assumed["reading_error_from"])
        val warning = summary.warnings().single { "the interval filter's bounds assume" in it }
        assertContains(warning, "no slower than a time constant of 60 s (--slowest) and readings off by no more than")
        assertContains(report(), "no slower than a time constant of 60 s (not given, taken), no reading is off by more")
        assertContains(report(), "0.002 mg/L, the step of the log")

        val given = json(smallSurvey(), "--filter", "interval", "--slowest", "20", "--reading-error", "0")
        val told = given.child("interval_assumes").mapValues { it.value.jsonPrimitive.content }
        assertEquals(listOf("20.0", "true", "0.0", "given"), told.values.toList())
        assertFalse(given.warnings().any { "assume" in it }, "${given.warnings()}")
        assertContains(report(), "no slower than a time constant of 20 s (as given)")

        assertFalse("interval_assumes" in json(smallSurvey(), "--filter", "averaging"))
    }

    @Test
    fun inventsNoValuesForWhatWasNotMeasured() {
        json(smallSurvey(), "--grid", "9x9", "--epsilon", "10")
        val rows = directory.out().resolve("cells.csv").readLines().drop(1).map { it.split(',') }
        for (row in rows) {
            val (value, lower, upper) = row.subList(7, 10)
            when (row.last()) {
                "unvisited", "none" -> assertEquals(listOf("", "", ""), listOf(value, lower, upper))
                else -> assertTrue(row[0] == "averaging" && value.isNotEmpty() && lower.isEmpty() && upper.isEmpty())
            }
        }
        assertEquals(setOf("measured", "unvisited", "none"), rows.map { it.last() }.toSet())
        val features = Json.parseToJsonElement(directory.out().resolve("cells.geojson").readText())
            .jsonObject.getValue("features").jsonArray.map { it.jsonObject.child("properties") }
        val bounded = features.first { it.getValue("filter").jsonPrimitive.content == "bounded" }
        assertEquals("none", bounded.getValue("status").jsonPrimitive.content)
        assertEquals(listOf(JsonNull, JsonNull, JsonNull), listOf("value", "lower", "upper").map(bounded::getValue))
    }

    @Test
    fun saysHowManyReadingsLieOutsideTheRange() {
        val text = "time_s,x_m,y_m,v\n" + (0 until 20).joinToString("") { "$it,$it,0,${it / 10.0}\n" }
        val summary = json(text, "--range", "0:1.45")
        assertEquals(5, summary.child("prior").getValue("readings_outside").jsonPrimitive.long)
        assertContains(summary.warnings().joinToString("\n"), "5 of 20 readings (25.0 %) lie outside --range")
        assertFalse(json(text).warnings().any { "--range" in it })
    }

    @Test
    fun takesNoStepOfACoarseSensorForASlope() {
        // 0.1 steps, each value for 20 s or more: the quietest minute has no slope but those of single steps.
        val text = "time_s,x_m,y_m,v\n" +
            (0 until 600).joinToString("") { "$it,$it,0,${Math.round(10 * (8 + sin(it / 100.0))) / 10.0}\n" }
        val summary = json(text)
        // 0.3 steps a second in a window of 5 medians, and 5 % more.
        assertEquals(0.0315, summary.getValue("epsilon_per_s").jsonPrimitive.content.toDouble(), 1e-9)
        assertFalse(summary.warnings().any { it.startsWith("epsilon") }, summary.warnings().toString())
        val own = json(text, "--epsilon", "0")
        assertContains(own.warnings().joinToString("\n"), "try --epsilon 0.0315")
    }

    @Test
    fun namesALongGapAndDrawsNoLineOverIt() {
        fun text(gap: Int) = "time_s,x_m,y_m,v\n" + (0 until 20).joinToString("") {
            "${if (it < 10) it else it + gap},${if (it < 10) it else it + 90},0,$it\n"
        }

        // The axes have lines of that colour, too; the two tracks have the same axes.
        fun lines() = Regex("stroke=\"rgb\\(138,144,150\\)\"")
            .findAll(directory.out().resolve("track.svg").readText()).count()
        val result = runMap(log(text(gap = 2940)), "--out", directory.out().toString())
        assertContains(result.stderr, "no reading for 2941 s (49.02 min) from 9 s after the first on")
        assertContains(result.stderr, "the next lies 91 m away")
        val inTwoParts = lines()
        val steady = runMap(log(text(gap = 0)), "--out", directory.out().toString())
        assertFalse("no reading for" in steady.stderr)
        assertEquals(lines() + 1, inTwoParts)
    }

    @Test
    fun showsTheUnitThatTheUserGaveAndNoOther() {
        val result = runMap(log(smallSurvey()), "--out", directory.out().toString(), "--unit", "mg/L")
        assertContains(result.stdout, "Map of do_mg_l (mg/L)")
        assertContains(report(), "do_mg_l (mg/L)")
        assertContains(directory.out().resolve("estimate-averaging.svg").readText(), "do_mg_l (mg/L)")
        assertEquals("mg/L", json(smallSurvey(), "--unit", "mg/L").getValue("unit").jsonPrimitive.content)
        assertEquals(JsonNull, json(smallSurvey()).getValue("unit"))
        assertFalse("mg/L" in report())
    }

    @Test
    fun countsATransectInItsOwnUnits() {
        val text = "time_s,pres_dbar,v\n" + (0 until 300).joinToString("") {
            "$it,${if (it / 30 % 2 == 0) it % 30 else 30 - it % 30},${it % 7}\n"
        }
        val result = runMap(log(text), "--out", directory.out().toString(), "--x", "pres_dbar", "--value", "v")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "units of pres_dbar per s")
        val words = report().replace(Regex("<svg.*?</svg>", RegexOption.DOT_MATCHES_ALL), "")
        assertFalse(Regex("""\d m\b|\(m\)|m/s|metres""").containsMatchIn(words.substringAfter("<body")))
    }

    @Test
    fun tellsTheBootstrapsSeedOnlyWhereThereIsABootstrap() {
        json("time_s,x_m,y_m,v\n0,0,0,1\n1,1,0,2\n2,2,0,3\n")
        assertFalse("seed" in report().lowercase())
    }
}
