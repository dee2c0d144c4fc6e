package stillwater.sensor

import kotlinx.serialization.Serializable
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.doubleOrNull
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import stillwater.model.JsonForm
import stillwater.model.JsonProblem
import kotlin.math.abs
import kotlin.random.Random

/**
 * A sensor as data: what the simulator runs, an estimator may assume and a diagnosis hands on.
 *
 * The JSON form is `{"name": "...", "stages": [{"type": "first-order-lag", "time_constant_s": 9.5}, ...]}`; the types
 * are those of [SensorStage].
 *
 * @property name what tables call the sensor.
 * @property stages its parts in the order in which they act on the truth; empty is a perfect sensor.
 */
@Serializable
public data class SensorSpec(val name: String, val stages: List<SensorStage>) {
    /**
     * A sensor of this kind that has settled at [initial].
     *
     * @param initial truth at which the sensor has come to rest, sensor units, finite. Each stage starts at what the one
     *   before it shows of that.
     * @param random where its noise comes from. Retained.
     * @throws IllegalArgumentException if [initial] is not finite.
     */
    public fun build(initial: Double, random: Random): SensorModel {
        require(initial.isFinite()) { "initial ($initial) must be finite" }
        var truth = initial
        return SensorChain(
            Array(stages.size) { i ->
                stages[i].build(truth, random).also {
                    truth =
                        stages[i].settled(truth)
                }
            },
        )
    }

    /** Names of the conditions that what it shows depends on, such as [stillwater.model.Conditions.SPEED]. */
    public val conditions: Set<String> get() = stages.flatMapTo(LinkedHashSet()) { it.conditions }

    /** The JSON form, indented. */
    public fun toJson(): String = FORMAT.encodeToString(serializer(), this)

    public companion object {
        /**
         * Longest time constant or dead time, and latest jump, that a spec may be read with, s: 32 years. No log is as
         * long, so that a larger one is a slip of the pen; and what is computed with it stays within what numbers can
         * hold.
         */
        public const val LONGEST_TIME: Double = 1e9

        /**
         * Largest size of every other number that a spec may be read with, in the unit of its field. A reading of that
         * size has no digit left behind the decimal point, so that a larger number is a slip of the pen, too.
         */
        public const val LARGEST_NUMBER: Double = 1e15

        private val FORMAT = Json {
            prettyPrint = true
            prettyPrintIndent = "  "
        }

        private val FORM = JsonForm(serializer(), "a sensor spec")

        /**
         * Reads the JSON form.
         *
         * @throws JsonProblem if [json] is not of that form or a number is out of its range; the message
         *   is one line that says where and what was expected.
         */
        public fun fromJson(json: String): SensorSpec = FORM.read(json).also { requireSizes(json, it) }

        /**
         * That the spec in [json] is of no use for its stage [index], from 0: [expected] tells what would be, [why] what
         * is wrong with that one.
         */
        public fun problem(json: String, index: Int, expected: String, why: String): JsonProblem {
            val stage = Json.encodeToJsonElement(SensorStage.serializer(), FORM.read(json).stages[index])
            val type = stage.jsonObject.getValue("type").jsonPrimitive.content
            return FORM.problem(json, "$.stages[$index]", "expected $expected, found $type: $why")
        }

        private fun requireSizes(json: String, spec: SensorSpec) {
            val stages = Json.encodeToJsonElement(serializer(), spec).jsonObject.getValue("stages").jsonArray
            stages.forEachIndexed { index, stage ->
                for ((name, value) in stage.jsonObject) requireSize(json, "$.stages[$index].$name", name, value)
            }
        }

        /** Refuses [value], the field [name] at [path], if it is a number beyond its limit or a list with such a one. */
        private fun requireSize(json: String, path: String, name: String, value: JsonElement) {
            if (value is JsonArray) {
                value.forEachIndexed { index, item -> requireSize(json, "$path[$index]", name, item) }
                return
            }
            val number = value.jsonPrimitive.takeUnless { it.isString }?.doubleOrNull ?: return
            val words = when {
                TIMES.any { name.endsWith(it) } && number > LONGEST_TIME ->
                    "expected at most $LONGEST_TIME s (32 years, longer than any log), found $number"
                abs(number) > LARGEST_NUMBER ->
                    "expected a number within -$LARGEST_NUMBER..$LARGEST_NUMBER, found $number"
                else -> return
            }
            throw FORM.problem(json, path, words)
        }

        private val TIMES = listOf("time_constant_s", "dead_time_s", "times_s")
    }
}
