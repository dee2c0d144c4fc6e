package stillwater.correct

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.buildJsonArray
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonArray
import kotlinx.serialization.json.putJsonObject
import stillwater.estimate.CandidateStanding
import stillwater.io.AddedColumns
import stillwater.io.AnnotatedLog
import stillwater.io.SurveyLog
import stillwater.report.HtmlReport
import stillwater.report.OutputDirectory
import stillwater.report.Program
import stillwater.report.Provenance
import stillwater.report.Table
import stillwater.report.counted
import stillwater.report.putOrigin
import stillwater.report.writeFigures

/**
 * Writes what a [CorrectedLog] gives: its columns of corrected.csv, sensor.json, summary.json, figures and report.html.
 *
 * Its columns stand in every row of the log behind the log's own; in rows that are no reading they are empty.
 *
 * @param result what to write. @param unit unit of the quantity, or null. @param command the command as typed.
 * @param heldOut scores of legs that the sensor was not learned on, or null where they were not asked for.
 * @param place directory of the files but corrected.csv, within the results', with a slash behind it, where other
 *   quantities of the log are corrected beside it, as [places] names it; its columns then have its name before theirs.
 *   Empty where it is alone.
 */
class CorrectFiles(
    private val result: CorrectedLog,
    unit: String?,
    private val command: String,
    private val heldOut: List<HeldOutScore>? = null,
    private val place: String = "",
) {
    private val isAlone = place.isEmpty()

    private val summary = CorrectSummary(result, unit, heldOut)

    /** Rows of the log that are no reading; known once written. */
    private var otherRows = 0L

    /** Warnings for the user, one line each. */
    val warnings: List<String> get() = summary.warnings + listOfNotNull(unused())

    private fun unused(): String? {
        if (otherRows == 0L) return null
        val have = if (otherRows == 1L) "has" else "have"
        return "${counted(otherRows, "row")} could not be used and $have empty cells"
    }

    /** The lines for the terminal: the answer, six facts, and one for the legs held out. */
    fun lines(): List<String> = listOf(summary.inShort) +
        summary.facts.take(TERMINAL_LINES + if (heldOut == null) 0 else 1).map { (name, value) -> "$name: $value" }

    /** The column that is corrected. */
    val quantity: String get() = result.log.quantity

    /** Names of the columns added to the log's. */
    val columns: List<String> = columns(result.log, isAlone)

    /** What is added to the rows of the log. */
    internal fun addedColumns(): AddedColumns {
        val series = result.series
        val track = result.track
        return AddedColumns(result.log, columns, series.times, series.xs, series.ys, series.values) { k ->
            listOf(track.values[k], track.lower[k], track.upper[k]).map(::cell)
        }
    }

    /**
     * Writes all files but corrected.csv, of which [otherRows] rows are no reading, into [directory], which the caller
     * commits; returns warnings about the figures.
     */
    internal fun write(directory: OutputDirectory, otherRows: Long): List<String> {
        this.otherRows = otherRows
        directory.retire(FIGURES.map { place + it })
        // Of an earlier run on one quantity.
        if (!isAlone) directory.retire(FIGURES + listOf("sensor.json", "summary.json", "report.html"))
        directory.write(place + "sensor.json", result.spec.toJson() + "\n")
        val figures = CorrectFigures(result, summary).draw()
        val drawing = directory.writeFigures(figures.map { place + it.name to it.figure })
        directory.write(place + "summary.json", json(drawing))
        directory.write(place + "report.html", page(figures))
        return drawing
    }

    /** Finer than any interval, of readings with a large offset too, such as 101325.37 Pa. */
    private fun cell(value: Double): String? =
        if (value.isFinite()) String.format(java.util.Locale.ROOT, "%.10g", value).toDouble().toString() else null

    private fun json(drawing: List<String>): String =
        FORMAT.encodeToString(JsonObject.serializer(), summaryJson(drawing)) + "\n"

    /** The summary for machines, with the warnings about [drawing]. */
    internal fun summaryJson(drawing: List<String>) = buildJsonObject {
        put("log", result.log.file.toString())
        put("quantity", quantity)
        putJsonArray("columns") { columns.forEach { add(JsonPrimitive(it)) } }
        putOrigin(result.log.frame)
        put("readings", result.series.size)
        put("other_rows", otherRows)
        putJsonObject("skipped") { result.pass.skipped.forEach { (reason, count) -> put(reason, count) } }
        putJsonArray("warnings") { (warnings + drawing).forEach { add(JsonPrimitive(it)) } }
        put("sensor_from", result.origin.name.lowercase())
        put("ambiguous", result.choice?.isAmbiguous ?: false)
        put("open", buildJsonArray { result.choice?.open?.forEach { add(JsonPrimitive(it.kind.label)) } })
        putJsonArray("candidates") { result.choice?.standings?.forEach { add(candidate(it)) } }
        result.before?.let { put("opposite_legs_before", finite(it.opposite.mean)) }
        result.after?.let { put("opposite_legs_after", finite(it.opposite.mean)) }
        // The readings smoothed in the same way with no lag undone.
        result.smoothed?.let { put("opposite_legs_smoothed", finite(it.opposite.mean)) }
        heldOut?.let { scores ->
            putJsonArray("held_out") { scores.forEach { add(split(it)) } }
        }
        put("mean_half_width", finite(summary.halfWidth))
        summary.laglessHalfWidth?.let { put("mean_half_width_without_lag", finite(it)) }
        summary.hintedHalfWidths?.let { (without, with) ->
            put("mean_half_width_without_hint", finite(without))
            put("mean_half_width_with_hint", finite(with))
        }
        putJsonObject("agreement") {
            put("crossings", result.agreement.crossings)
            put("places", result.agreement.places)
            put("alike", result.agreement.alike)
            put("ratio", finite(result.agreement.ratio))
            put("ratio_error", finite(result.agreement.error))
            put("lateness_s", finite(result.agreement.lateness))
            put("spread", finite(result.agreement.spread))
            put("widened", result.isWidenedForPasses)
            // Null where crossings show it better, or nothing was learned from passes.
            put("unevenness_s", result.learned.unevenness(result.agreement)?.let(::finite))
            put("widened_for_unevenness", result.isWidenedForUnevenness)
        }
        result.wander?.let {
            putJsonObject("zero") {
                put("still_probability", finite(it.still))
                put("wander_at_end", finite(it.walked))
                // Null where the legs do not speak for it.
                put("mean_half_width", summary.wanderedHalfWidth?.let(::finite))
            }
        }
        result.margin?.let {
            putJsonObject("reference") {
                put("rows", it.rows)
                put("covered", finite(it.covered))
                put("factor", finite(it.factor))
                put("held_out_covered", finite(it.heldOut))
                put("widened", it.isMisfit)
            }
        }
        put("left_out", result.track.outlying.count { it })
        put("at_range_end", result.track.clipped.count { it })
        put("learned_on", result.learned.readings)
        put("blocks", result.learned.blocks)
        put("blocks_alike", result.learned.alike)
    }

    private fun candidate(standing: CandidateStanding) = buildJsonObject {
        put("response", standing.candidate.kind.label)
        putJsonObject("parameters") {
            standing.candidate.kind.parameters.forEachIndexed { i, name ->
                val interval = standing.candidate.interval(i)
                putJsonObject(name) {
                    put("value", standing.candidate.parameter(i))
                    put("low", finite(interval.start))
                    // Null where the log does not say how large it may be.
                    put("high", finite(interval.endInclusive))
                }
            }
        }
        put("mean_delay_s", finite(standing.candidate.response.meanDelay))
        put("held_out_score", finite(standing.candidate.heldOutScore))
        put("behind", finite(standing.behind))
        put("behind_error", finite(standing.error))
        put("open", standing.isOpen)
        put("weight", finite(standing.weight))
    }

    private fun split(score: HeldOutScore) = buildJsonObject {
        put("learned_on", score.learnedOn)
        put("legs", score.legs)
        put("opposite_legs_before", finite(score.before))
        put("opposite_legs_after", finite(score.after))
        put("opposite_legs_smoothed", finite(score.smoothed))
        score.passes?.let {
            put("pairs_of_passes", it.pairs)
            put("passes_rms_before", it.before)
            put("passes_rms_after", it.after)
            put("passes_rms_smoothed", finite(it.smoothed))
        }
    }

    /** JSON has no other numbers. */
    private fun finite(number: Double): Double? = number.takeIf { it.isFinite() }

    private fun page(figures: List<CorrectFigure>): String {
        val page = HtmlReport(
            "Correction of ${summary.quantity}",
            "${result.log.file.fileName}, ${result.log.format}",
            Provenance(
                Program.VERSION,
                command,
                SensorLearning.SEED.takeIf { result.choice != null },
                "Bootstrap seed",
            ),
        )
        page.answer(summary.inShort)
        summary.facts.forEach { (name, value) -> page.summary(name, value) }
        warnings.forEach(page::warning)
        for (figure in figures) page.section(figure.figure.title) { figure(figure.figure, figure.caption) }
        result.choice?.let { choice ->
            page.section("Candidates") {
                table(
                    Table.of(choice.standings) {
                        text("Response") { summary.words(it.candidate) }
                        number("Mean delay (s)") { it.candidate.response.meanDelay }
                        number("Behind the best") { it.behind }
                        number("Standard error") { it.error }
                        text("Open") { if (it.isOpen) "yes" else "no" }
                        number("Weight") { it.weight }
                    },
                )
            }
        }
        page.section("How it was made") { HOW.forEach(::paragraph) }
        return page.render()
    }

    companion object {
        /**
         * A directory for each of [quantities], a number behind the name where two come to the same, be it but for
         * capitals, which some file systems take for the same; an empty one where there is only one quantity.
         */
        fun places(quantities: List<String>): List<String> {
            if (quantities.size == 1) return listOf("")
            val taken = HashSet<String>()
            return quantities.map { quantity ->
                val name = quantity.map { if (it.isLetterOrDigit() || it in "_-") it else '_' }.joinToString("")
                val numbered = generateSequence(2) { it + 1 }.map { "${name}_$it" }
                (sequenceOf(name) + numbered).first { taken.add(it.lowercase()) } + "/"
            }
        }

        /**
         * Refuses [log] if it has a column of the names that are added to it, where it is corrected [isAlone] or not.
         *
         * @throws stillwater.io.LogProblem if so.
         */
        fun requireNewColumns(log: SurveyLog, isAlone: Boolean) =
            AnnotatedLog.requireNewNames(log, columns(log, isAlone))

        private fun columns(log: SurveyLog, isAlone: Boolean) =
            if (isAlone) COLUMNS else COLUMNS.map { "${log.quantity}_$it" }

        private const val TERMINAL_LINES = 6
        private val COLUMNS = listOf("corrected", "corrected_low", "corrected_high")
        private val FIGURES = CorrectFigures.NAMES.flatMap { listOf("$it.svg", "$it.png") }
        private val FORMAT = Json { prettyPrint = true }
        private val HOW = listOf(
            "A slow sensor drags old water along, so that passes in different directions disagree. Each candidate " +
                "response is undone in phase only, and short runs of the track are foretold from the other passes " +
                "near them; the better they agree, the higher its score. Each group of runs is scored with " +
                "parameters one Newton step from the best ones towards what the other groups alone would give; how " +
                "rough the water is was learned from all of them.",
            "A response is ruled out if its score is behind another's by more than 2.6 standard errors, taken from " +
                "the scatter between groups of neighbouring runs. What is not ruled out stays open, and the " +
                "corrected value is the mean over it; but an asymmetric lag or two paths give way to something " +
                "simpler that they hold and that explains about as much.",
            "The value and its interval come from a Kalman smoother with the sensor's response in its state. How " +
                "rough the water is along the track and how noisy the readings are is learned from the log; detail " +
                "that the sensor has smoothed away is not made up but left open in the interval.",
            "A limit on the rate of change is recognised only where readings often run at just that rate, both ways: " +
                "noise of a quarter to a half of a second's largest change hides it. Then a lag is learned in its " +
                "place, and the intervals cover less than 95 %. A sensor known to be rate limited is better " +
                "given with --sensor. A lag before a limit that was found is learned from what the sensor would show " +
                "without it.",
            "Where the track does not cross itself, delays of single runs are held against that of the response: " +
                "what they scatter by beyond a row's time or a second, which fixes may be off, widens the intervals " +
                "where the water changes along the track.",
            "A reading that stands alone, as no water here does, and rows of one number far from all others, such as " +
                "0 or 9999, are left out: such a row is foretold from the others, and its interval reaches to the " +
                "reading. Of a reading at an end of the sensor's range it is known " +
                "that the sensor was there or beyond.",
        )
    }
}
