package stillwater.model

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import kotlinx.serialization.json.JsonElement
import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class JsonFormTest {
    @Serializable
    private data class Buoy(
        @SerialName("depth_m") val depth: Double,
        val count: Int = 1,
        val marks: List<String>? = null,
    ) {
        init {
            require(depth >= 0) { "depth ($depth m) must be at least 0" }
        }
    }

    private val form = JsonForm(Buoy.serializer(), "a buoy")
    private val any = JsonForm(JsonElement.serializer(), "JSON")

    private fun said(text: String) = assertFailsWith<JsonProblem>(text) { form.read(text) }.message.orEmpty()

    @Test
    fun whatIsWrongIsSaidWithPlaceFieldExpectationAndFinding() {
        val fields = "depth_m, count, marks"
        for ((text, expected) in listOf(
            "" to "1:1: expected an object in braces with $fields, found the end",
            "[1]" to "1:1: expected an object in braces with $fields, found a list in brackets",
            "7" to "1:1: expected an object in braces with $fields, found '7'",
            "{}" to "1:1: expected the field depth_m, found none",
            """{"depth_m": 2, "depth_m": 3}""" to
                "1:16: expected each field once, found 'depth_m' again, which 1:2 has already",
            "{\"depth_m\": 2,\n \"count\": 1,\n\t\"depth_m\": 2}" to
                "3:2: expected each field once, found 'depth_m' again, which 1:2 has already",
            """{"depth_m": 2, "dep\u0074h_m": 3}""" to
                "1:16: expected each field once, found 'depth_m' again, which 1:2 has already",
            """{"depth_m": 2, "colour": 3}""" to "1:16: expected one of $fields, found 'colour'",
            """{"depth_m": "2"}""" to "1:13: depth_m: expected a number, found the text '2'",
            """{"depth_m": {"m": 2}}""" to "1:13: depth_m: expected a number, found an object in braces",
            """{"depth_m": 2, "count": 1.5}""" to "1:25: count: expected a whole number, found '1.5'",
            """{"depth_m": 2, "count": 9999999999}""" to "1:25: count: expected a whole number, found '9999999999'",
            """{"depth_m": 2, "count": null}""" to "1:25: count: expected a whole number, found 'null'",
            """{"depth_m": 1e999}""" to "1:13: depth_m: expected a number, found '1e999'",
            """{"depth_m": 02}""" to "1:13: depth_m: expected a number, found '02'",
            """{"depth_m": 2, "marks": "a"}""" to "1:25: marks: expected a list in brackets, found the text 'a'",
            """{"depth_m": 2, "marks": ["a", 3]}""" to "1:31: marks[1]: expected a text in quotes, found '3'",
            """{"depth_m": 2, "marks": ["a" "b"]}""" to
                "1:30: marks: expected a comma or a closing bracket, found the text 'b'",
            """{"depth_m": 2, "marks": ["\q"]}""" to
                "1:27: marks[0]: expected an escape of JSON such as \\n, \\\" or \\u00b5, found another; " +
                "a backslash itself is written twice",
            "{\"depth_m\": 2, \"marks\": [\"a]}\n" to
                "1:30: marks[0]: expected no control character in a text, found one; a quotation mark may be missing",
            """{"depth_m" 2}""" to "1:12: expected a colon, found '2'",
            """{depth_m: 2}""" to "1:2: expected a field's name in quotes, found 'depth_m'",
            """{"depth_m": 2,}""" to "1:15: expected a field's name in quotes, found '}'",
            """{"depth_m": 2""" to "1:14: expected a comma or a closing brace, found the end",
            "{\"depth_m\": 2}\n{\"depth_m\": 3}" to "2:1: expected nothing more, found an object in braces",
            "{\"count\": 1,\n \"depth_m\": -2}" to "2:13: depth (-2.0 m) must be at least 0",
        )) {
            assertEquals("not a buoy: $expected", said(text))
        }
    }

    @Test
    fun goodOnesAreRead() {
        val buoy = Buoy(2.5, 3, listOf("a", "\"µ\"", "b"))
        val text = """{ "marks" : ["a", "\"\u00b5\"", "b"] , "count":3,"depth_m":25e-1}"""
        assertEquals(buoy, form.read(text))
        assertEquals(buoy, form.read("\uFEFF" + text), "a byte order mark is no part of it")
        assertEquals(Buoy(0.0), form.read("{\"depth_m\":-0.0e0,\r\n\"marks\":null}").copy(depth = 0.0))
    }

    @Test
    fun freeFormTextsAreHeldToTheSameRules() {
        assertEquals("""{"a":[1,{"b":null}]}""", any.read("""{"a": [1, {"b": null}]}""").toString())
        fun said(text: String) = assertFailsWith<JsonProblem>(text.take(40)) { any.read(text) }.message
        assertEquals(
            "not JSON: 1:20: expected each field once, found 'b' again, which 1:13 has already",
            said("""{"a": [1, { "b": 1,"b": 2}]}"""),
        )
        val deep = "[".repeat(1_000_000)
        assertEquals(
            "not JSON: 1:66: expected no more than 64 brackets one within the other, found a list in brackets",
            said(deep),
        )
        assertFalse(JsonForm.isShallow(deep))
        assertTrue(JsonForm.isShallow("""{"a":"${"[".repeat(1000)}\"["}"""))
        assertTrue(JsonForm.isShallow("[]".repeat(1000)))
    }

    /** Cuts and changes good texts at random: a problem is said in one line, and nothing else is thrown. */
    @Test
    fun noTextMakesItThrowAnythingElse() {
        val seed = 20_261_122L
        val random = Random(seed)
        val good = """{"depth_m": 2.5e0, "count": -3, "marks": ["a\u00b5\\", "", "b"]}"""
        repeat(20_000) { round ->
            val marks = "{}[]\",:\\u0 -eE.\u0000\uD800nt1"
            val characters = good.toCharArray()
            repeat(1 + random.nextInt(3)) {
                characters[random.nextInt(characters.size)] = marks.random(random)
            }
            val text = String(characters).take(random.nextInt(good.length + 1) + good.length / 2)
            for (form in listOf(form, any)) {
                try {
                    form.read(text)
                } catch (problem: JsonProblem) {
                    assertEquals(1, problem.message.orEmpty().lines().size, "seed $seed, round $round: $text")
                }
            }
        }
    }
}
