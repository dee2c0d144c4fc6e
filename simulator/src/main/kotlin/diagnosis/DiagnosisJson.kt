package stillwater.diagnosis

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArrayBuilder
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonObjectBuilder
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.add
import kotlinx.serialization.json.addJsonArray
import kotlinx.serialization.json.addJsonObject
import kotlinx.serialization.json.buildJsonArray
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonArray
import kotlinx.serialization.json.putJsonObject
import stillwater.diagnose.Candidate
import stillwater.diagnose.ChannelLags
import stillwater.diagnose.Estimate
import stillwater.diagnose.ModelAssessment
import stillwater.model.Interval
import stillwater.report.putOrigin
import stillwater.sensor.SensorSpec

/** diagnosis.json: a [Diagnosed] log for machines; numbers unrounded, null where there is none. */
internal object DiagnosisJson {
    private val format = Json { prettyPrint = true }

    /** The text. */
    fun text(diagnosed: Diagnosed): String = format.encodeToString(JsonObject.serializer(), of(diagnosed)) + "\n"

    private fun of(diagnosed: Diagnosed) = buildJsonObject {
        val result = diagnosed.result
        put("verdict", result.verdict.label)
        put("answer", diagnosed.answer)
        putJsonArray("causes") { diagnosed.causes.forEach { add(it) } }
        putJsonArray("candidates") { result.candidates.forEach { candidate(it) } }
        put("baseline", model(result.baseline, result.baseSensor))
        put("extended", result.extended?.let { model(it, checkNotNull(result.extendedSensor)) } ?: JsonNull)
        put("gain", gain(diagnosed))
        putJsonArray("ambiguity") {
            result.verdict.ambiguity.forEach { set -> addJsonArray { set.forEach { add(it.label) } } }
        }
        put("separatingManoeuvre", result.separatingManoeuvre)
        diagnosed.channels?.let { put("channels", channels(it)) }
        putOrigin(diagnosed.log.frame)
        putJsonArray("warnings") { diagnosed.warnings.forEach { add(it) } }
    }

    private fun JsonArrayBuilder.candidate(candidate: Candidate) = addJsonObject {
        put("cause", candidate.cause.label)
        put("parameters", parameters(candidate.parameters, candidate.condition))
        put("trainRmse", number(candidate.trainRmse))
        put("heldOutRmse", number(candidate.heldOutRmse))
        put("pValue", number(candidate.pValue))
        put("adjustedPValue", number(candidate.adjustedPValue))
    }

    private fun parameters(estimates: List<Estimate>, condition: String?) = buildJsonArray {
        for (estimate in estimates) {
            addJsonObject {
                val of = if (condition != null && estimate.name == "coefficient") " of $condition" else ""
                put("name", estimate.name + of)
                put("unit", estimate.unit)
                put("value", number(estimate.value))
                put("lower", number(estimate.interval?.lower ?: Double.NaN))
                put("upper", number(estimate.interval?.upper?.takeIf { it < Estimate.OPEN } ?: Double.NaN))
            }
        }
    }

    private fun model(model: ModelAssessment, sensor: SensorSpec) = buildJsonObject {
        put("parameters", parameters(model.parameters, null))
        put("trainRmse", number(model.trainRmse))
        put("heldOutRmse", number(model.heldOutRmse))
        put("heldOutLogLikelihood", number(model.heldOutLogLikelihood))
        putJsonObject("noise") {
            put("standardDeviation", number(model.noiseSpread))
            put("correlatedShare", number(model.noiseShare))
            put("correlationTime_s", number(model.noiseTime))
        }
        put("sensor", Json.parseToJsonElement(sensor.toJson()))
    }

    private fun gain(diagnosed: Diagnosed): JsonElement {
        val before = diagnosed.result.baseline
        val after = diagnosed.result.extended ?: return JsonNull
        return buildJsonObject {
            put("heldOutRmseBefore", number(before.heldOutRmse))
            put("heldOutRmseAfter", number(after.heldOutRmse))
            put("heldOutLogLikelihoodBefore", number(before.heldOutLogLikelihood))
            put("heldOutLogLikelihoodAfter", number(after.heldOutLogLikelihood))
            put(
                "map",
                diagnosed.worth?.let { worth ->
                    buildJsonObject {
                        put("errorWithBaseline", number(worth.before))
                        put("errorWithExtended", number(worth.after))
                        put("differenceStandardError", number(worth.error))
                        put("environments", worth.environments)
                    }
                } ?: JsonNull,
            )
        }
    }

    /** Which part of the lag all channels share, and which is the sensor's own. */
    private fun channels(lags: ChannelLags) = buildJsonObject {
        putJsonArray("deadTimes") {
            for (channel in lags.channels) {
                addJsonObject {
                    put("name", channel.name)
                    put("isSeen", channel.isSeen)
                    interval("dead_time_s", channel.delay, channel.interval)
                }
            }
        }
        put("mostCommon_s", number(lags.common ?: Double.NaN))
        putJsonObject("leastOwn") { interval("dead_time_s", lags.own ?: Double.NaN, lags.ownInterval) }
    }

    private fun JsonObjectBuilder.interval(name: String, value: Double, interval: Interval?) {
        put(name, number(value))
        put("lower", number(interval?.lower ?: Double.NaN))
        put("upper", number(interval?.upper ?: Double.NaN))
    }

    private fun number(value: Double): JsonElement = if (value.isFinite()) JsonPrimitive(value) else JsonNull
}
