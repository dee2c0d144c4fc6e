package stillwater.io

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.writeBytes
import kotlin.io.path.writeText
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class MissionFileTest {
    @TempDir
    private lateinit var directory: Path

    private fun problem(old: String, new: String): String {
        check(old in POND) { old }
        val wrong = assertFailsWith<JsonFileProblem>(new) { MissionFile.parse(POND.replace(old, new), "pond.json") }
        assertEquals(1, wrong.message.orEmpty().lines().size)
        return wrong.message.orEmpty()
    }

    @Test
    fun whatIsWrongIsSaidWithItsPlaceAndWhatWasExpected() {
        for ((old, new, expected) in listOf(
            Triple("45.5", "90", "3:25: origin: lat_deg (90.0) must not be at a pole"),
            Triple("\"columns\": 6", "\"columns\": 0", "5:59: grid: columns (0) must be at least 1"),
            Triple(
                "\"columns\": 6",
                "\"columns\": \"six\"",
                "5:59: grid.columns: expected a whole number, found the text 'six'",
            ),
            Triple("\"columns\": 6", "\"columns\": 1.5", "5:59: grid.columns: expected a whole number, found '1.5'"),
            Triple("\"columns\": 6, ", "", "5:11: grid: expected the field columns, found none"),
            Triple("\"lowest\": 0", "\"lowest\": NaN", "6:66: probe.lowest: expected a number, found 'NaN'"),
            Triple(
                "lawnmower",
                "mower",
                "7:14: planner: expected one of random-walk, lawnmower, bounded, bounded-extended, information, " +
                    "settling-lawnmower, polygon-rrt, found 'mower'",
            ),
            Triple(
                "\"seconds\": 900",
                "\"minutes\": 15",
                "8:14: budget: expected one of metres, seconds, reserve, found 'minutes'",
            ),
            Triple("900", "1e300", "8:25: budget: seconds (1.0E300 s) must be above 0 and at most 1000000.0"),
            Triple("900", "0", "8:25: budget: seconds (0.0 s) must be above 0 and at most 1000000.0"),
            Triple(
                "\"seconds\": 900",
                "\"metres\": 2e6",
                "8:24: budget: metres (2000000.0 m) must be above 0 and at most 1000000.0",
            ),
            Triple("{\"seconds\": 900}", "{}", "8:13: budget: a budget needs either metres or seconds"),
            Triple(
                "\"home\": {",
                "\"home\": [",
                "9:11: home: expected an object in braces with x_m, y_m, found a list in brackets",
            ),
            Triple("\"x_m\": 5,", "\"x_m\": 500,", "9:11: home (500.0, 5.0) must lie on the water"),
            Triple(
                "\"budget\"",
                "\"home\": {\"x_m\": 75, \"y_m\": 75},\n  \"budget\"",
                "10:3: expected each field once, found 'home' again, which 8:3 has already",
            ),
            Triple(
                "\"cell_m\": 10",
                "\"cell_m\": 30",
                "7:14: this planner goes from cell to cell, but the cell at (75.0, 15.0) or the way from it to the " +
                    "next is not all within the area or touches a keep-out; take a grid within the area, or polygon-rrt",
            ),
            Triple(
                "\"y_m\": 80}",
                "\"y_m\": {}}",
                "4:85: area.north_east.y_m: expected a number, found an object in braces",
            ),
        )) {
            assertEquals("pond.json:$expected", problem(old, new))
        }
    }

    /** Of these estimators or figures made no numbers, and the mission was lost at its end. */
    @Test
    fun aProbeThatCannotBeReckonedWithIsRefused() {
        for ((lowest, highest, expected) in listOf(
            Triple(
                "-1e308",
                "1e308",
                "6:85: probe.highest: expected numbers within -1.0E60..1.0E60, found -1.0E308 to",
            ),
            Triple("-1e61", "15", "6:66: probe.lowest: expected numbers within -1.0E60..1.0E60, found -1.0E61 to 15.0"),
            Triple("0", "1e300", "6:80: probe.highest: expected numbers within -1.0E60..1.0E60, found 0.0 to 1.0E300"),
            Triple(
                "0",
                "1e-300",
                "6:80: probe.highest: expected a range with an end beyond ±1.0E-30, found 0.0 to 1.0E-300",
            ),
        )) {
            val said = problem("\"lowest\": 0, \"highest\": 15", "\"lowest\": $lowest, \"highest\": $highest")
            assertEquals("pond.json:$expected", said.take("pond.json:$expected".length))
        }
        val slow = "6:111: probe.longest_time_constant_s: expected at most 1.0E9 s (32 years), found 1.0E308 s"
        assertEquals("pond.json:$slow", problem("15}", "15, \"longest_time_constant_s\": 1e308}"))
        val large = POND.replace("\"highest\": 15", "\"highest\": 1e60")
        assertEquals(1e60, MissionFile.parse(large, "pond.json").probe.highest)
    }

    @Test
    fun whatIsNoJsonIsSaidToo() {
        for ((text, expected) in listOf(
            "" to "1:1: expected an object in braces with name, origin,",
            "[]" to "1:1: expected an object in braces with name, origin,",
            POND.dropLast(2) to "9:31: expected a comma or a closing brace, found the end",
            POND.replace("\"home\"", "home") to "9:3: expected a field's name in quotes, found 'home'",
        )) {
            val wrong = assertFailsWith<JsonFileProblem> { MissionFile.parse(text, "pond.json") }
            assertEquals("pond.json:$expected", wrong.message.orEmpty().take("pond.json:$expected".length))
        }
    }

    @Test
    fun aFileThatCannotBeReadIsNamed() {
        fun said(file: Path) = assertFailsWith<JsonFileProblem> { MissionFile.read(file) }.message.orEmpty()
        val none = directory.resolve("none.json")
        assertEquals("$none: expected a mission (JSON), found no such file", said(none))
        assertEquals("$directory: expected a mission (JSON), found a directory", said(directory))
        val bytes = directory.resolve("bytes.json").apply { writeBytes(byteArrayOf(-1, -2, 3)) }
        assertEquals("$bytes: expected a mission (JSON), found bytes that are no UTF-8 text", said(bytes))
    }

    @Test
    fun aGoodOneIsRead() {
        val file = Files.createFile(directory.resolve("pond.json")).apply { writeText(POND) }
        assertEquals("pond", MissionFile.read(file).name)
    }

    private companion object {
        const val POND = """{
  "name": "pond",
  "origin": {"lat_deg": 45.5, "lon_deg": -73.6},
  "area": {"south_west": {"x_m": -20, "y_m": -20}, "north_east": {"x_m": 80, "y_m": 80}},
  "grid": {"south_west": {"x_m": 0, "y_m": 0}, "columns": 6, "rows": 6, "cell_m": 10},
  "probe": {"quantity": "dissolved-oxygen", "port": 1, "lowest": 0, "highest": 15},
  "planner": "lawnmower",
  "budget": {"seconds": 900},
  "home": {"x_m": 5, "y_m": 5}
}
"""
    }
}
