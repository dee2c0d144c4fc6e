package stillwater.diagnosis

import stillwater.diagnose.Candidate
import stillwater.diagnose.ModelAssessment
import stillwater.report.HtmlReport
import stillwater.report.Program
import stillwater.report.Provenance
import stillwater.report.SignificantDigits
import stillwater.report.Table

/** The page about a [Diagnosed] log, for someone who has two minutes. */
internal class DiagnosisReport(
    private val diagnosed: Diagnosed,
    private val figures: List<DiagnosisFigure>,
    command: String,
) {
    private val result = diagnosed.result
    private val three = SignificantDigits(3)
    private val checks = if (diagnosed.isFitted) diagnosed.checks.all else emptyList()
    private val page = HtmlReport(
        title = "Diagnosis of ${diagnosed.quantity}",
        subtitle = "${diagnosed.log.file.fileName}, ${diagnosed.log.format}",
        provenance = Provenance(Program.VERSION, command),
    )

    /** The page's text. */
    fun render(): String {
        page.answer(diagnosed.answer)
        page.summary("Verdict", result.verdict.label)
        page.summary("Causes", diagnosed.causes.joinToString(", ").ifEmpty { "–" })
        page.summary("Rows", "${diagnosed.log.columns.size}")
        val isHeldOut = !result.baseline.heldOutRmse.isNaN()
        val residuals = if (isHeldOut) "Residuals on held-out blocks" else "Residuals, nothing held out"
        fun shown(model: ModelAssessment) = if (diagnosed.isFitted) {
            three.format(if (isHeldOut) model.heldOutRmse else model.trainRmse) + diagnosed.unitAfter
        } else {
            "nothing was fitted"
        }
        page.summary("$residuals, base", shown(result.baseline))
        if (!diagnosed.isBaseNamed) result.extended?.let { page.summary("The same, extended", shown(it)) }
        diagnosed.warnings.forEach(page::warning)
        page.section("The answer") { answer() }
        if (diagnosed.isFitted) page.section("Measured and predicted") { show("predicted") }
        if (figures.any { it.name.startsWith("cause-") }) {
            page.section("The causes") {
                figures.filter { it.name.startsWith("cause-") }.forEach { figure(it.figure, it.caption) }
            }
        }
        if (diagnosed.isFitted) {
            page.section("All causes tried") { tried() }
            page.section("What the residuals depend on") { residuals() }
        }
        page.section("How it was done") { HOW.forEach(::paragraph) }
        return page.render()
    }

    private fun stillwater.report.ReportSection.show(name: String) {
        figures.firstOrNull { it.name == name }?.let { figure(it.figure, it.caption) }
    }

    private fun stillwater.report.ReportSection.answer() {
        paragraph(diagnosed.answer)
        diagnosed.calibration?.let { paragraph("${it.replaceFirstChar { first -> first.uppercase() }}.") }
        result.separatingManoeuvre?.let { paragraph("What would tell the causes apart: $it.") }
        val after = result.extended ?: return
        val before = result.baseline
        if (diagnosed.isBaseNamed) {
            paragraph(
                "What the readings follow the water by is the lag of the base model itself: " +
                    "${diagnosed.numbers(after.parameters)}. extended-sensor.json holds it${diagnosed.besideBase}.",
            )
            return leftOver()
        }
        if (!before.heldOutRmse.isNaN()) heldOut(before, after)
        diagnosed.worth?.let { worth ->
            paragraph(
                "Worth for a map: in ${worth.environments} simulated fields sampled by the extended sensor, the " +
                    "interval filter's error is ${three.format(
                        worth.before,
                    )} of the field's range with the base model's limits and " +
                    "${three.format(worth.after)} with the extended model's (standard error of the difference " +
                    "${three.format(worth.error)}).",
            )
        }
        keyValues(after.parameters.map { diagnosed.name(it) to diagnosed.number(it) })
        leftOver()
    }

    /** Intervals are worth what the model is: where more than chance is left, the reader must know. */
    private fun stillwater.report.ReportSection.leftOver() {
        val outside = checks.filter { it.isOutside }
        if (outside.size < 2) return
        paragraph(
            "What is left is more than noise: ${outside.size} of the ${checks.size} checks of the residuals below " +
                "are outside of what noise alone gives. The model is not all of the truth, and the intervals, which " +
                "hold if it is, are rather too narrow.",
        )
    }

    private fun stillwater.report.ReportSection.heldOut(before: ModelAssessment, after: ModelAssessment) {
        val gain = three.format(after.heldOutLogLikelihood - before.heldOutLogLikelihood)
        paragraph(
            "On blocks of the log that the model was not fitted to, the residuals (root mean square) go from " +
                "${three.format(before.heldOutRmse)} to ${three.format(after.heldOutRmse)}${diagnosed.unitAfter}, " +
                "and the log-likelihood rises by $gain.",
        )
    }

    private fun stillwater.report.ReportSection.tried() {
        if (diagnosed.log.reference == null && result.candidates.isNotEmpty()) {
            paragraph(
                "Each row is a cause beside a lag; where a time constant cannot be told from a dead time, beside " +
                    "both, and the time constant is then what the dead time leaves of the lag, less than the " +
                    "answer's. Residuals can be held against each other within this table only. The lag itself is " +
                    "not among the rows: whether it is at work the answer says.",
            )
        }
        table(
            Table.of(result.candidates) {
                text("Cause") { candidate: Candidate ->
                    candidate.cause.label +
                        (candidate.condition?.let { " ($it)" } ?: "")
                }
                text("Numbers (95 %)") { diagnosed.numbers(it.parameters) }
                number("Residuals") { it.trainRmse }
                number("On held-out blocks") { it.heldOutRmse }
                number("p, for all tried") { it.adjustedPValue }
            },
        )
    }

    private fun stillwater.report.ReportSection.residuals() {
        figures.filter {
            it.name.startsWith("residuals-") || it.name in DiagnosisFigures.WHITENED
        }.forEach { figure(it.figure, it.caption) }
        table(
            Table.of(checks) {
                text("Whitened residuals of the best model") { it.name }
                number("Value") { it.value }
                number("Noise alone, from") { it.lower }
                number("to") { it.upper }
            },
        )
        table(
            Table.of(result.dependences) {
                text("What is left depends on") { it.description }
                number("Likelihood ratio") { it.ratio }
                number("p, for all looks") { it.adjusted }
            },
        )
    }

    private companion object {
        val HOW = listOf(
            "The base is a first-order lag with gain and offset, or the sensor that was given. Each cause is added " +
                "to it and fitted to the log's own times by maximum likelihood, with noise of which a part may be " +
                "correlated.",
            "A cause is named only if its likelihood ratio, divided by what the scores' remaining correlation " +
                "inflates it, is significant for all causes tried (Holm) and the likelihood of held-out blocks " +
                "rises. Causes that this track hardly tells apart are named together: the set holds the right one " +
                "with nine chances in ten.",
            "That readings lie on steps they show by themselves: rounding is named where it makes a quarter of the " +
                "noise, whatever it gains. Blocks are held out for causes that are worth a look; the others have none.",
            "Intervals hold if the model is right.",
        )
    }
}
