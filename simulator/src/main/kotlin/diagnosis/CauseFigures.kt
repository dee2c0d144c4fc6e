package stillwater.diagnosis

import stillwater.diagnose.Candidate
import stillwater.diagnose.Cause
import stillwater.diagnose.Revisits
import stillwater.diagnose.Verdict
import stillwater.model.Conditions
import stillwater.plot.AxisScale
import stillwater.plot.LinePlot
import stillwater.plot.Mark
import stillwater.plot.Series
import stillwater.survey.ValueResolution
import kotlin.math.floor

/**
 * Draws the causes of a [Diagnosed] log: what each adds over time, and of those of the answer also what shows them best, such as
 * the loop of a hysteresis, the line of a cross-sensitivity or the response to a step.
 *
 * @param residual of the base in each row, sensor units. @param rate how fast the base's prediction changes, sensor units/s.
 * @param curve a column over time with its name.
 */
internal class CauseFigures(
    private val diagnosed: Diagnosed,
    private val residual: DoubleArray,
    private val rate: DoubleArray,
    private val curve: (String, DoubleArray) -> Series,
) {
    private val columns = diagnosed.log.columns
    private val result = diagnosed.result
    private val n = columns.size
    private val time = DoubleArray(n) { columns.times[it] - columns.times[0] }
    private val stride = maxOf(1, n / DiagnosisFigures.MOST_POINTS)
    private val residualLabel = diagnosed.residualLabel

    /** The causes of the answer. */
    private val named: List<Cause> = when (val verdict = result.verdict) {
        is Verdict.Named -> verdict.causes
        is Verdict.Ambiguous -> verdict.sets.flatten()
        else -> emptyList()
    }

    /** What draws each figure, in the order in which a reader wants them. */
    fun drawings(): List<() -> DiagnosisFigure> = buildList {
        val step = if (named.any { it in OF_STEP }) step() else null
        for (candidate in causes()) {
            add { overTime(candidate) }
            if (candidate.cause !in named) continue
            if (candidate.cause in OF_STEP) step?.let { add { response(candidate.cause, it) } }
            detail(candidate)?.let(::add)
        }
        if (Cause.OUTLIERS in named) add { outliers() }
        if (Cause.TIME_VARYING_FIELD in named) result.revisits?.let { add { revisits(it) } }
    }

    /** The causes of the answer, and others that look likely. */
    private fun causes(): List<Candidate> =
        result.candidates.filter { it.cause !in BESIDE && (it.cause in named || it.adjustedPValue < LIKELY) }
            .distinctBy { it.cause }

    private fun change(candidate: Candidate) =
        DoubleArray(n) { candidate.predicted[it] - result.baseline.predicted[it] }

    private fun overTime(candidate: Candidate): DiagnosisFigure {
        val series = listOf(curve(RESIDUAL, residual), curve(ADDED, change(candidate)))
        val isNamed = candidate.cause in named
        val plot = LinePlot(
            candidate.cause.label,
            if (isNamed) "" else "likely by itself, but not named",
            series,
            TIME,
            residualLabel,
            references = listOf(0.0),
        )
        val caption = when {
            isNamed -> candidate.cause.sentence
            result.verdict is Verdict.Unexplained ->
                "A hint, and not named: it explains a part and not the rest. Tried was: ${candidate.cause.sentence}"
            else -> "Not named. Tried was: ${candidate.cause.sentence}"
        }
        return DiagnosisFigure("cause-${candidate.cause.label}", plot.draw(), caption)
    }

    /** What a named cause does with the quantity that it goes with; null where the course over time says it all. */
    private fun detail(candidate: Candidate): (() -> DiagnosisFigure)? {
        val quantity = diagnosed.quantity
        val shown = result.baseline.predicted
        return when (candidate.cause) {
            Cause.HYSTERESIS, Cause.SATURATION, Cause.GAIN_OFFSET -> {
                { against(candidate, "Predicted value of $quantity", shown) }
            }
            Cause.ASYMMETRIC_RESPONSE, Cause.SLEW_LIMIT -> {
                { against(candidate, "Predicted rate of change (${diagnosed.inUnit("sensor units")}/s)", rate) }
            }
            Cause.QUANTISATION -> ValueResolution.of(columns.values).takeIf { it > 0 }?.let { step ->
                val within = DoubleArray(n) { shown[it] - floor(shown[it] / step) * step }
                ({ against(candidate, "Predicted value above the step below it", within) })
            }
            Cause.CROSS_SENSITIVITY -> candidate.condition?.let { name ->
                columns.condition(name)?.let { column -> { against(candidate, name, column) } }
            }
            Cause.TEMPERATURE_DEPENDENT_RESPONSE ->
                columns.condition(Conditions.TEMPERATURE)?.let { { lags(candidate, "Temperature (°C)", it) } }
            Cause.FLOW_DEPENDENT_RESPONSE -> {
                { lags(candidate, "Speed (m/s)", diagnosed.log.series.let { it.shown(it.speed) }) }
            }
            else -> null
        }
    }

    private fun against(candidate: Candidate, label: String, x: DoubleArray): DiagnosisFigure {
        val rows = (0 until n step stride).filter { x[it].isFinite() }
        fun points(name: String, y: DoubleArray) = Series(
            name,
            DoubleArray(rows.size) { x[rows[it]] },
            DoubleArray(rows.size) { y[rows[it]] },
            mark = Mark.POINTS,
        )
        val series = listOf(points(RESIDUAL, residual), points(ADDED, change(candidate)))
        return detail(
            candidate.cause,
            LinePlot(candidate.cause.label, "", series, label, residualLabel, references = listOf(0.0)),
            "The same against what it goes with.",
        )
    }

    /** By how much readings are later than the base has them in parts of [column]: minus the slope of residuals by rates. */
    private fun lags(candidate: Candidate, label: String, column: DoubleArray): DiagnosisFigure {
        val order = column.indices.filter { column[it].isFinite() }.sortedBy { column[it] }
        val parts = order.chunked(maxOf(1, (order.size + PARTS - 1) / PARTS))
        val middles = DoubleArray(parts.size) { part -> parts[part].sumOf { column[it] } / parts[part].size }
        fun later(name: String, y: DoubleArray, mark: Mark) = Series(
            name,
            middles,
            DoubleArray(parts.size) { part ->
                -parts[part].sumOf { y[it] * rate[it] } / parts[part].sumOf { rate[it] * rate[it] }
            },
            mark = mark,
        )
        val series = listOf(later("measured", residual, Mark.POINTS), later(ADDED, change(candidate), Mark.LINE))
        val lag = "Later than the base has it (s)"
        return detail(
            candidate.cause,
            LinePlot(candidate.cause.label, "", series, label, lag, references = listOf(0.0)),
            "By how much longer than the base model says the readings take, in $PARTS parts of as many rows: how " +
                "residuals go with the predicted rate of change.",
        )
    }

    private fun step() = result.extendedSensor?.let { StepResponse(result.baseSensor, it, medians()) }

    private fun medians() = Conditions(
        listOf(Conditions.SPEED to diagnosed.log.series.let { it.shown(it.speed) }).plus(
            listOfNotNull(columns.condition(Conditions.TEMPERATURE)?.let { Conditions.TEMPERATURE to it }),
        ).associate { (name, column) ->
            name to
                ResidualChecks.percentile(column.filter(Double::isFinite).toDoubleArray(), HALF)
        },
    )

    private fun response(cause: Cause, step: StepResponse) = detail(
        cause,
        LinePlot(
            cause.label,
            "",
            step.curves(),
            "Time since a step of the water (s)",
            "Share of the step yet to be shown",
            yScale = AxisScale.LOG10,
        ),
        "What the base model and the extended one have yet to show of a step of the water. One lag is a straight line.",
    )

    private fun detail(cause: Cause, plot: LinePlot, caption: String) =
        DiagnosisFigure("cause-${cause.label}-$DETAIL", plot.draw(), caption)

    private fun outliers(): DiagnosisFigure {
        val far = result.spikes
        val series = listOf(
            Series(RESIDUAL, time, residual, mark = Mark.POINTS),
            Series(
                "far off",
                DoubleArray(far.size) { time[far[it]] },
                DoubleArray(far.size) { residual[far[it]] },
                mark = Mark.POINTS,
            ),
        )
        val label = Cause.OUTLIERS.label
        val plot = LinePlot(label, "", series, TIME, residualLabel, references = listOf(0.0))
        return DiagnosisFigure("cause-$label", plot.draw(), Cause.OUTLIERS.sentence)
    }

    /** What the reference says where the track crosses itself. */
    private fun revisits(revisits: Revisits): DiagnosisFigure {
        val shown = revisits.later.indices step maxOf(1, revisits.later.size / DiagnosisFigures.MOST_POINTS)
        val longest = revisits.later.max()
        val series = listOf(
            Series(
                "crossings",
                shown.map { revisits.later[it] }.toDoubleArray(),
                shown.map { revisits.higher[it] }.toDoubleArray(),
                mark = Mark.POINTS,
            ),
            Series("even change", doubleArrayOf(0.0, longest), doubleArrayOf(0.0, longest * revisits.rate)),
        )
        val label = Cause.TIME_VARYING_FIELD.label
        val plot = LinePlot(
            label,
            "",
            series,
            "Time between two visits of a place (s)",
            "Change of the reference",
            references = listOf(0.0),
        )
        return DiagnosisFigure("cause-$label", plot.draw(), Cause.TIME_VARYING_FIELD.sentence)
    }

    companion object {
        private const val RESIDUAL = "residual of the base"
        private const val ADDED = "what the cause adds"
        private const val TIME = "Time since the first row (s)"
        private const val DETAIL = "detail"

        /** Causes that do not show in what the model predicts. */
        private val BESIDE = setOf(Cause.OUTLIERS, Cause.TIME_VARYING_FIELD)

        /** Causes that the response to a step shows. */
        private val OF_STEP =
            setOf(Cause.TIME_CONSTANT, Cause.SECOND_ORDER_RESPONSE, Cause.TWO_PATH_RESPONSE, Cause.DEAD_TIME)

        /** Probability by chance, for all causes tried, below which one is drawn that was not named. */
        private const val LIKELY = 0.05
        private const val PARTS = 12
        private const val HALF = 50.0

        /** All names that a figure may have. */
        val NAMES: List<String> = Cause.entries.flatMap { listOf("cause-${it.label}", "cause-${it.label}-$DETAIL") }
    }
}
