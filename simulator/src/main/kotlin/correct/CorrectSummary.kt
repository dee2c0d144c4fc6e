package stillwater.correct

import stillwater.estimate.CandidateResponse
import stillwater.estimate.CorrectedTrack
import stillwater.estimate.ResponseKind
import stillwater.report.counted
import stillwater.sensor.SensorStage
import stillwater.survey.LagShift
import stillwater.survey.Wording.Companion.digits
import stillwater.survey.Wording.Companion.duration
import stillwater.survey.Wording.Companion.percent

/**
 * A [CorrectedLog] in words.
 *
 * @param result what it is about. @param unit unit of the quantity, or null. @param heldOut scores of legs held out, or
 * null where they were not asked for.
 */
internal class CorrectSummary(
    private val result: CorrectedLog,
    unit: String?,
    private val heldOut: List<HeldOutScore>? = null,
) {
    /** The unit after a number, with a blank before it; empty without one. */
    val unitAfter: String = unit?.let { " $it" }.orEmpty()

    private val trust = CorrectTrust(result, unitAfter)
    private val cautions = CorrectCautions(result, unitAfter)

    /** The quantity with its unit. */
    val quantity: String = unit?.let { "${result.log.quantity} ($it)" } ?: result.log.quantity

    /** The sensor in one sentence. */
    val sensor: String
        get() {
            val choice = result.choice
            return when {
                result.origin == SensorOrigin.NOTHING ->
                    "not learned: nothing in the log shows it; taken as without lag"
                choice == null -> SensorStages.words(result.spec).ifEmpty { "without lag" }
                result.origin == SensorOrigin.RATE -> "${limit()}; before it: $open"
                else -> open
            }
        }

    private val open: String
        get() = different.joinToString("; ", transform = ::words).let {
            if (different.size > 1) "cannot be told apart on this log: $it" else it
        }

    /** The rate limit, in words. */
    private fun limit(): String {
        val limit = result.spec.stages.filterIsInstance<SensorStage.Slew>().first()
        return "slew-limit: rate per s ${digits(limit.rate, 3)}"
    }

    /** What is open, but for responses whose further part is none, so that they are others over again. */
    private val different: List<CandidateResponse> = result.choice?.open.orEmpty().let { open ->
        open.filterNot { one -> one.kind.parameters.indices.any { isNone(one, it) } }.ifEmpty { open.take(1) }
    }

    /** [candidate] with its parameters and their 95 % intervals. */
    fun words(candidate: CandidateResponse): String {
        if (candidate.kind == ResponseKind.NONE) return "no lag"
        val parameters = candidate.kind.parameters.indices.joinToString(", ") { i ->
            val interval = candidate.interval(i)
            if (isNone(candidate, i)) {
                // Its own interval is of a logarithm, which goes on and on towards none.
                val least = digits(maxOf(interval.endInclusive, result.series.medianStep / STEP_PARTS), 2)
                val name = SensorStages.parameter(candidate.kind.parameters[i]).removeSuffix(" in s")
                return@joinToString "$name none found, under $least s"
            }
            // Of a narrow interval the ends would be written alike.
            val count = (3..MOST_DIGITS).firstOrNull { least(candidate, i, it) != most(candidate, i, it) } ?: 3
            val value = digits(candidate.parameter(i), count)
            "${SensorStages.parameter(candidate.kind.parameters[i])} $value" +
                " (${least(candidate, i, count)} to ${most(candidate, i, count)})"
        }
        val at = if (candidate.kind == ResponseKind.FLOW) " (at ${digits(result.series.referenceSpeed, 2)} m/s)" else ""
        return "${candidate.kind.label}$at: $parameters"
    }

    private fun isTime(candidate: CandidateResponse, i: Int) =
        candidate.kind.parameters[i].let { it.endsWith("_s") && it != SensorStages.RATE }

    /** Of a time far below the distance of rows all digits are chance. */
    private fun least(candidate: CandidateResponse, i: Int, count: Int): String {
        val start = candidate.interval(i).start
        val isNothing = isTime(candidate, i) && start < result.series.medianStep / STEP_PARTS
        return if (isNothing && candidate.parameter(i) > start * STEP_PARTS) "0" else digits(start, count)
    }

    private fun most(candidate: CandidateResponse, i: Int, count: Int): String {
        val end = candidate.interval(i).endInclusive
        // Of a time that is a hundred times the value nothing is known but that it is open.
        val isOpen = isTime(candidate, i) && end > OPEN * maxOf(candidate.parameter(i), result.series.medianStep)
        return if (isOpen) "not bounded by this log" else digits(end, count)
    }

    /** Whether the time that parameter [i] is is too short to be seen in rows so far apart. */
    private fun isNone(candidate: CandidateResponse, i: Int) = isTime(candidate, i) &&
        candidate.interval(i).endInclusive < result.series.medianStep / 2

    /** Mean half width of the intervals, sensor units. */
    val halfWidth: Double get() = halfWidth(result.track)

    /** The same without, and with, what the log only hints at, sensor units; null where it hints at nothing. */
    val hintedHalfWidths: Pair<Double, Double>?
        get() = result.hinted?.let { halfWidth(result.unhinted) to halfWidth(it) }

    /** The same if the zero wandered, sensor units; null where that does not look likely. */
    val wanderedHalfWidth: Double? get() = result.wandered?.let(::halfWidth)

    private fun halfWidth(track: CorrectedTrack) = track.meanHalfWidth

    /** The same if a sensor of which nothing is known has no lag, sensor units; null where something is known. */
    val laglessHalfWidth: Double? get() = result.unknown?.second?.let(::halfWidth)

    private fun interval(): String {
        result.unknown?.let { (lag, lagless) ->
            val without = digits(halfWidth(lagless), 3)
            return "95 %, $without$unitAfter either way on average ${trust.words}; as written, for any lag of up to " +
                "${digits(lag, 2)} s, ${digits(halfWidth, 3)}$unitAfter"
        }
        val other = hintedHalfWidths?.let { (without, with) ->
            val words = if (holdsHint) "if there is no slow path" else "with the slow path that the log hints at"
            " (${digits(if (holdsHint) without else with, 3)}$unitAfter $words)"
        }.orEmpty()
        return "95 %, ${digits(halfWidth, 3)}$unitAfter either way on average${within()}$other; ${trust.words}"
    }

    /** Where some rows are at an end of the range the mean is hardly that of any row. */
    private fun within(): String {
        val track = result.track
        val rows = track.values.indices.filterNot { track.clipped[it] || track.outlying[it] }
        if (rows.isEmpty() || track.clipped.none { it }) return ""
        val mean = rows.sumOf { (track.upper[it] - track.lower[it]) / 2 } / rows.size
        return ", ${digits(mean, 3)}$unitAfter within the sensor's range"
    }

    private val holdsHint: Boolean get() = result.track === result.hinted

    /** What was found and done, in a sentence or three for somebody who knows no responses. */
    val inShort: String get() = CorrectInShort(result, different, unitAfter, halfWidth, isWorse = cautions.isWorse).text

    /** Names and values, in order; the first six go to the terminal. */
    val facts: List<Pair<String, String>>
        get() = buildList {
            add("log" to "${result.log.file.fileName} (${result.log.format})")
            add("sensor" to sensor)
            add("evidence" to evidence())
            add("opposite legs" to legs())
            add("rows" to rows())
            add("interval" to interval())
            heldOut?.let { add("held out" to heldOut(it)) }
            heldOut?.let(::passes)?.let { add("passes not learned on" to it) }
            add("duration" to duration(result.statistics.duration))
            val resolution = result.statistics.resolution
            add("resolution" to if (resolution.isFinite()) digits(resolution) + unitAfter else "none found")
        }

    private fun evidence(): String = when (result.origin) {
        SensorOrigin.REVISITS ->
            "${result.learned.blocks} runs of the track foretold by other passes, " +
                "from ${result.learned.readings} readings" + unseen()
        SensorOrigin.REFERENCE -> "${result.learned.readings} readings with a reference"
        else -> result.origin.label
    }

    /** What passes of a track cannot show: a slow path's few percent move features less than the lag's own error. */
    private fun unseen(): String =
        if (result.choice?.open?.any { it.kind.hasTwoPaths } != false || result.choice?.hinted != null) {
            ""
        } else {
            "; a slow path with a share of a few percent would not show, and is not in the intervals"
        }

    /** Why the log says nothing about its sensor. */
    private fun silence(): String {
        val series = result.series
        if (isFlat(series.values)) return "the readings never change"
        if (!result.log.hasPlaces) return "the log has no places"
        if (result.learned.alike > 0) {
            val but = if (result.agreement.crossings > 0) ", but in too few places" else ""
            return "passes near each other go the same way at the same speed, and agree whatever the sensor's lag$but"
        }
        val count = if (result.agreement.crossings > 0) "too few passes come" else "no pass comes"
        return result.learned.stillBoat ?: "$count near another"
    }

    private fun legs(): String {
        val before = result.before
        val after = result.after
        if (before == null || after == null || !(before.opposite.mean > 0)) return "none to compare"
        val change = 1 - after.opposite.mean / before.opposite.mean
        val plain = result.smoothed?.opposite?.mean
        val smoothed = plain?.let { "${digits(it, 3)}$unitAfter smoothed alike with no lag undone, " }.orEmpty()
        val differ = "differ by ${digits(before.opposite.mean, 3)}$unitAfter as measured, $smoothed" +
            "${digits(after.opposite.mean, 3)}$unitAfter corrected"
        before.otherWater?.let {
            val apart = "legs one way lie ${digits(it.distance, 3)} m beside those the other way"
            return "$differ; no lag is told from that: $apart, in other water"
        }
        // Of few legs the share is chance, and read as a judgement all the same.
        if (after.scores.size < LagShift.FEWEST_LEGS) return "$differ; too few legs to tell, ${after.scores.size}"
        val thanSmoothed = plain?.let { " than measured, ${lessOrMore(1 - after.opposite.mean / it)} than smoothed" }
        return "$differ (${lessOrMore(change)}${thanSmoothed.orEmpty()})"
    }

    private fun lessOrMore(change: Double) =
        if (change >= 0) "${percent(change)} less" else "${percent(-change)} more"

    private fun heldOut(scores: List<HeldOutScore>): String {
        if (scores.isEmpty()) return "fewer than ${HeldOutLegs.FEWEST} legs, or no sensor learned from them"
        val each = scores.joinToString { "${percent(it.gain)} learned on ${it.learnedOn}" }
        val mean = percent(scores.sumOf { it.gain } / scores.size)
        val lag = scores.map { it.lagGain }.filter { it.isFinite() }
        val ofLag = if (lag.isEmpty()) "" else "; than smoothed alike with no lag undone, ${lessOrMore(lag.average())}"
        return "legs not learned on differ by $mean less on average ($each)$ofLag"
    }

    /** Root mean square differences of successive passes; null where the legs are no passes of one transect. */
    private fun passes(scores: List<HeldOutScore>): String? {
        val found = scores.mapNotNull { score -> score.passes?.let { score.learnedOn to it } }
        if (found.isEmpty()) return null
        fun mean(of: (HeldOutPasses) -> Double) = digits(found.sumOf { of(it.second) } / found.size, 3)
        val each = found.joinToString { (words, score) -> "${digits(score.after, 3)} learned on $words" }
        val smoothed = if (found.any { it.second.smoothed.isNaN() }) {
            ""
        } else {
            "${mean { it.smoothed }}$unitAfter smoothed alike with no lag undone, "
        }
        return "rms ${mean { it.before }}$unitAfter as measured, $smoothed" +
            "${mean { it.after }}$unitAfter corrected on average ($each)"
    }

    private fun rows(): String {
        val skipped = result.pass.skipped.entries.joinToString("") { "; ${it.value} ${it.key}" }
        return "${result.series.size} corrected${cautions.inShort}$skipped"
    }

    private fun hint(twoPaths: CandidateResponse): String {
        val share = twoPaths.kind.parameters.lastIndex
        val range = twoPaths.interval(share)
        val hint = "the log hints at a slow path with a share of ${percent(twoPaths.parameter(share))} " +
            "(${percent(range.start)} to ${percent(range.endInclusive)})"
        return if (holdsHint) {
            "$hint, too weakly to undo it: the values are without it, the intervals were widened to hold it"
        } else {
            "$hint and does not bound it: values and intervals are without it. Slow changes of the water look alike; " +
                "if the sensor has such a path, its intervals are ${digits(checkNotNull(hintedHalfWidths).second, 2)}" +
                "$unitAfter either way"
        }
    }

    /** What the user should know, one line each. */
    val warnings: List<String>
        get() = buildList {
            addAll(result.pass.warnings)
            when {
                result.origin == SensorOrigin.NOTHING -> add(
                    "${silence()}, so that nothing shows how the sensor responds: the values are smoothed only; " +
                        "give --sensor${if (result.learned.fault == null) " or --reference" else ""}",
                )
                result.choice?.open?.any { it.kind == ResponseKind.NONE } == true ->
                    add("a lag is not told from none: the intervals cover both")
                different.size > 1 -> add(
                    "the log leaves ${different.size} responses open " +
                        different.joinToString(prefix = "(", postfix = "): ") { it.kind.label } +
                        "the intervals cover them all; sensor.json holds the most likely",
                )
            }
            result.unknown?.let { (lag, lagless) ->
                add(
                    "intervals hold a sensor with any lag of up to ${digits(lag, 2)} s, no slower one; without lag " +
                        "they are ${digits(halfWidth(lagless), 2)}$unitAfter either way",
                )
            }
            result.learned.fault?.let { fault ->
                val instead = if (result.origin == SensorOrigin.NOTHING) {
                    "nothing was learned"
                } else {
                    "the sensor is ${result.origin.label} instead"
                }
                add("the reference does not show how the sensor responds: $fault; $instead")
            }
            result.choice?.hinted?.takeIf { result.hinted != null }?.let { add(hint(it)) }
            if (isFlat(result.series.values)) {
                add("the readings are all the same, as a stuck sensor's: intervals are half a last digit either way")
            }
            addAll(cautions.ofSensor)
            addAll(trust.warnings)
            val silent = result.track.silent.count { it }
            if (silent > 0) {
                val readings = counted(silent, "reading")
                add("at $readings the sensor ran at its limit and shows the water from one side only")
            }
            addAll(cautions.lines)
            if (result.learned.isPart) {
                val middle = "on the ${result.learned.readings} readings in the middle of the log"
                if (result.origin == SensorOrigin.REVISITS) add("the sensor was learned $middle")
                if (result.origin ==
                    SensorOrigin.RATE
                ) {
                    add("the rate limit is of all readings, the lag before it $middle")
                }
            }
            if (result.learned.held) {
                add(
                    "the reference looks held over each step, as a simulation that steps once a row holds it: " +
                        "sensor.json is for such a simulation; what is undone here is half a step shorter",
                )
            }
            val without = result.learned.withoutReference
            if (without > 0) add("${counted(without, "reading")} ${if (without == 1) "has" else "have"} no reference")
        }

    private companion object {

        /** Times below such a part of the distance of rows are none, however narrow their interval. */
        const val STEP_PARTS = 10

        /** Digits of an interval's ends at most, however narrow it is. */
        const val MOST_DIGITS = 6

        /** Times the value, or the distance of rows. */
        const val OPEN = 100
    }
}
