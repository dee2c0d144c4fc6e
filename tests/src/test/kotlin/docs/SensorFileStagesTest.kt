package stillwater.docs

import kotlinx.serialization.ExperimentalSerializationApi
import kotlinx.serialization.descriptors.elementDescriptors
import kotlinx.serialization.descriptors.elementNames
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.jsonObject
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import stillwater.architecture.Repository
import stillwater.model.JsonProblem
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** docs/sensor-files.md has the stages that the program has, with their fields and ranges, and its examples are read. */
@OptIn(ExperimentalSerializationApi::class)
class SensorFileStagesTest {
    private val page = Repository.text("docs/sensor-files.md")

    /** A field as the page has it; [range] in its words, [isOptional] where the page says what holds without it. */
    private class Field(val name: String, val range: String?, val isOptional: Boolean)

    private class Row(val type: String, val fields: List<Field>, val example: String)

    private val rows = ROW.findAll(page).map { row ->
        val (type, fields, example) = row.destructured
        Row(
            type,
            FIELD.findAll(fields).map { found ->
                val parts = found.groupValues[2].split("; ")
                Field(found.groupValues[1], parts.getOrNull(1), parts.size > 2)
            }.toList(),
            example,
        )
    }.toList()

    /** By type each stage's fields, and whether they may be left out, as they are read. */
    private val read = SensorStage.serializer().descriptor.elementDescriptors.last().let { stages ->
        stages.elementNames.zip(stages.elementDescriptors).associate { (type, stage) ->
            type to stage.elementNames.mapIndexed { i, name -> name to stage.isElementOptional(i) }.toMap()
        }
    }

    @Test
    fun itHasEachStageOnceWithItsFields() {
        assertEquals(read.keys, rows.map { it.type }.toSet())
        assertEquals(read.size, rows.size)
        for (row in rows) assertEquals(read[row.type], row.fields.associate { it.name to it.isOptional }, row.type)
    }

    @Test
    fun theFirstExampleIsASensor() {
        assertEquals(5, SensorSpec.fromJson(page.substringAfter("```json\n").substringBefore("```")).stages.size)
    }

    @TestFactory
    fun examplesAreReadAndRangesAreThoseThatAreHeldTo(): List<DynamicTest> = rows.map { row ->
        dynamicTest(row.type) {
            val example = Json.parseToJsonElement(row.example).jsonObject
            accept(example)
            for (field in row.fields) {
                val words = field.range ?: continue
                val range = RANGES[words] ?: error("$words is no range")
                for (number in range.inside) accept(beside(example, field.name, number))
                for (number in range.outside) {
                    val wrong = beside(example, field.name, number)
                    assertFailsWith<JsonProblem>("$wrong") { SensorSpec.fromJson(spec(wrong)) }
                }
            }
        }
    }

    private fun accept(stage: JsonObject) {
        assertEquals(1, SensorSpec.fromJson(spec(stage)).stages.size, "$stage")
    }

    private fun spec(stage: JsonObject) = """{"name": "one", "stages": [$stage]}"""

    /** [stage] with [number] for [field], and what the field is measured against moved out of its way. */
    private fun beside(stage: JsonObject, field: String, number: Double): JsonObject {
        val value: JsonElement = JsonPrimitive(number)
        val others = when (field) {
            "fast_time_constant_s" -> mapOf("slow_time_constant_s" to JsonPrimitive(maxOf(number, TINY)))
            "slow_time_constant_s" -> mapOf("fast_time_constant_s" to JsonPrimitive(TINY))
            "lower" -> mapOf("upper" to JsonPrimitive(HUGE * 2))
            "upper" -> mapOf("lower" to JsonPrimitive(-HUGE * 2))
            "times_s" -> mapOf("offsets" to JsonArray(listOf(JsonPrimitive(1))))
            "offsets" -> mapOf("times_s" to JsonArray(listOf(JsonPrimitive(1))))
            else -> emptyMap()
        }
        val own = if (stage[field] is JsonArray) JsonArray(listOf(value)) else value
        return JsonObject(stage + others + (field to own))
    }

    /** Numbers of a range, its ends where they are of it, and numbers next to it. */
    private class Numbers(val inside: List<Double>, val outside: List<Double>)

    private companion object {
        val ROW = Regex("""(?m)^\| `([a-z-]+)` \|[^|]*\|([^|]*)\| `(\{.*\})` \|$""")
        val FIELD = Regex("""`(\w+)` \(([^)]*)\)""")

        const val TINY = 1e-9

        /** Below the longest time that is taken, s. */
        const val HUGE = 1e8

        fun closed(low: Double, high: Double) = Numbers(
            listOf(low, (low + high) / 2, high),
            listOf(Math.nextDown(low), Math.nextUp(high)),
        )

        val RANGES = mapOf(
            "above 0" to Numbers(listOf(TINY, 1.0, HUGE), listOf(0.0, -1.0)),
            "at least 0" to Numbers(listOf(0.0, 1.0, HUGE), listOf(-TINY)),
            "at least 1" to Numbers(listOf(1.0, HUGE), listOf(Math.nextDown(1.0), 0.0)),
            "not 0" to Numbers(listOf(-HUGE, -TINY, TINY, HUGE), listOf(0.0)),
            "any" to Numbers(listOf(-HUGE, 0.0, HUGE), emptyList()),
            "0 to 1" to closed(0.0, 1.0),
            "-2 to 2" to closed(-2.0, 2.0),
            "-0.5 to 0.5" to closed(-0.5, 0.5),
        )
    }
}
