package stillwater.diagnosis

import stillwater.diagnose.Candidate
import stillwater.diagnose.Cause
import stillwater.diagnose.Revisits
import stillwater.diagnose.Verdict
import stillwater.estimate.TrackSeries
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import stillwater.plot.Figure
import stillwater.plot.LinePlot
import stillwater.plot.Mark
import stillwater.plot.NullDistributions
import stillwater.plot.Series
import stillwater.plot.TrackMap
import stillwater.plot.drawConcurrently
import stillwater.survey.Wording.Companion.digits
import kotlin.math.hypot

/** A figure with the name of its files and what it shows. */
internal class DiagnosisFigure(val name: String, val figure: Figure, val caption: String)

/**
 * Draws a [Diagnosed] log: predicted against measured, the residuals against all that they may depend on, the causes.
 *
 * @param survey the log as it was read, which knows whether it has one coordinate only and what that is called.
 */
internal class DiagnosisFigures(private val diagnosed: Diagnosed, private val survey: SurveyLog) {
    private val columns = diagnosed.log.columns
    private val result = diagnosed.result
    private val quantity = diagnosed.quantity
    private val residualLabel = diagnosed.residualLabel
    private val n = columns.size
    private val time = DoubleArray(n) { columns.times[it] - columns.times[0] }
    private val residual = DoubleArray(n) { columns.values[it] - result.baseline.predicted[it] }
    private val stride = maxOf(1, n / MOST_POINTS)

    /** How fast the base's prediction changes at each row, sensor units/s. */
    private val rate = DoubleArray(n) { i ->
        val from = maxOf(i - 1, 0)
        val to = minOf(i + 1, n - 1)
        if (to == from) 0.0 else result.baseline.predicted.let { (it[to] - it[from]) / (time[to] - time[from]) }
    }
    private val track by lazy { TrackSeries(columns.times, columns.x, columns.y, columns.values) }
    private val means by lazy {
        val base = result.baseline
        ResidualMeans(residual, time, CorrelatedNoise(base.noiseSpread, base.noiseShare, base.noiseTime))
    }
    private val moves = hypot(spread(columns.x), spread(columns.y)) > 1e-9

    /**
     * All figures in the order in which a reader wants them, with their PNGs, on up to all cores; none where nothing
     * was fitted, for each of them shows a model.
     */
    fun draw(): List<DiagnosisFigure> =
        if (diagnosed.isFitted) drawConcurrently(drawings()) { it.figure } else emptyList()

    private fun drawings(): List<() -> DiagnosisFigure> = buildList {
        add { predicted() }
        addAll(CauseFigures(diagnosed, residual, rate, ::curve).drawings())
        add { against("time", "Time since the first row (s)", time) }
        add { against("value", "Predicted value of $quantity", result.baseline.predicted) }
        add { against("rate", "Predicted rate of change (${diagnosed.inUnit("sensor units")}/s)", rate) }
        if (moves) {
            // As they were tested.
            val series = diagnosed.log.series
            val unit = if (columns.condition(Conditions.SPEED) == null) survey.speedUnit else "m/s"
            add { against("speed", "Speed ($unit)", series.shown(series.speed)) }
            // Along a single coordinate there are two directions, and no heading.
            if (!survey.oneDimensional || diagnosed.log.heading != null) add { heading() }
            add { if (survey.oneDimensional) against("position", survey.xName, columns.x) else position() }
        }
        columns.condition(Conditions.TEMPERATURE)?.let { add { against("temperature", "Temperature (°C)", it) } }
        add { correlation() }
        if (diagnosed.checks.all.isNotEmpty()) add { checks() }
    }

    private fun predicted(): DiagnosisFigure {
        val series = listOfNotNull(
            curve("measured", columns.values),
            curve("base", result.baseline.predicted),
            result.extended?.takeIf { it !== result.baseline }?.let { curve("extended", it.predicted) },
        )
        val plot = LinePlot("Measured and predicted", "", series, "Time since the first row (s)", quantity)
        return DiagnosisFigure(
            "predicted",
            plot.draw(),
            "What was measured and what the simulation shows on the same track.",
        )
    }

    /** [column] over time, interrupted where nothing was logged. */
    private fun curve(name: String, column: DoubleArray): Series {
        val gaps = (1 until n).filter(track::isAfterGap)
        if (gaps.isEmpty()) return Series(name, time, column)
        val x = time.toMutableList()
        val y = column.toMutableList()
        for (row in gaps.asReversed()) {
            x.add(row, (time[row - 1] + time[row]) / 2)
            y.add(row, Double.NaN)
        }
        return Series(name, x.toDoubleArray(), y.toDoubleArray())
    }

    private fun heading(): DiagnosisFigure {
        val series = diagnosed.log.series
        val degrees = degrees(series.shown(series.heading))
        val custom = if (diagnosed.log.heading == null) "counter-clockwise from east" else "as logged"
        val caption = "The base model's residuals; the larger points are their means in sectors of " +
            "${ResidualMeans.SECTOR.toInt()} degrees, at the mean heading of their rows, with two standard errors " +
            "that allow for their correlation. Sectors beside each other are joined."
        return against("heading", "Heading (degrees $custom)", degrees, means.inSectors(degrees), caption)
    }

    private fun against(
        name: String,
        label: String,
        x: DoubleArray,
        mean: List<Series> = means.inParts(x),
        caption: String = IN_PARTS,
    ): DiagnosisFigure {
        val rows = (0 until n step stride).filter { x[it].isFinite() }
        val points = Series(
            "residual",
            DoubleArray(rows.size) { x[rows[it]] },
            DoubleArray(rows.size) { residual[rows[it]] },
            mark = Mark.POINTS,
        )
        val plot = LinePlot(
            "Residuals against $name",
            "",
            listOf(points) + mean,
            label,
            residualLabel,
            references = listOf(0.0),
        )
        return DiagnosisFigure(
            "residuals-$name",
            plot.draw(),
            caption,
        )
    }

    private fun position(): DiagnosisFigure {
        val rows = (0 until n step stride).toList()
        val map = TrackMap(
            "Residuals along the track",
            "",
            DoubleArray(rows.size) { columns.x[rows[it]] },
            DoubleArray(rows.size) { columns.y[rows[it]] },
            DoubleArray(rows.size) { residual[rows[it]] },
            residualLabel,
            isDifference = true,
        )
        return DiagnosisFigure("residuals-position", map.draw(), "The base model's residuals where they were measured.")
    }

    private fun correlation(): DiagnosisFigure {
        val lags = minOf(MOST_LAGS, n / 4)
        val x = DoubleArray(lags) { it + 1.0 }
        val (lower, upper) = diagnosed.checks.correlations(lags)
        val band = Series("noise alone (95 %)", x, DoubleArray(lags) { Double.NaN }, lower, upper)
        val plot = LinePlot(
            "Correlation of the residuals",
            "",
            listOf(
                band,
                Series("as measured", x, ResidualChecks.correlations(residual, lags), mark = Mark.LINE_AND_POINTS),
                Series(
                    "whitened, best model",
                    x,
                    ResidualChecks.correlations(diagnosed.best.whitened, lags),
                    mark = Mark.LINE_AND_POINTS,
                ),
            ),
            "Lag (rows of ${digits(track.medianStep)} s)",
            "Correlation",
            references = listOf(0.0),
        )
        return DiagnosisFigure(
            CORRELATION,
            plot.draw(),
            "Correlated residuals make everything look significant; the tests use the whitened ones. The band is " +
                "where these are in 95 of 100 simulated logs that the model is right about.",
        )
    }

    private fun checks() = DiagnosisFigure(
        CHECKS,
        NullDistributions(NULLS, "", diagnosed.checks.all.map { it.drawn() }).draw(),
        "What the whitened residuals of the best model have (the marks), and what they have in simulated logs that " +
            "it is right about (the densities). A mark far from its density is structure that the model has not.",
    )

    private fun degrees(radians: DoubleArray) = DoubleArray(radians.size) { Math.toDegrees(radians[it]).mod(360.0) }

    private fun spread(column: DoubleArray) = (column.maxOrNull() ?: 0.0) - (column.minOrNull() ?: 0.0)

    companion object {
        /** Points in a figure. */
        const val MOST_POINTS = 2000
        private const val MOST_LAGS = 60
        private const val IN_PARTS =
            "The base model's residuals; the line is their mean in twenty equal parts, with two standard errors that " +
                "allow for their correlation."

        private const val CORRELATION = "correlation"
        private const val CHECKS = "checks"
        private const val NULLS = "Residuals of the best model and their null distributions"

        /** Names of figures of whitened residuals. */
        val WHITENED = listOf(CORRELATION, CHECKS)

        /** All names that a figure may have. */
        val NAMES = WHITENED + "predicted" +
            listOf("time", "value", "rate", "speed", "heading", "position", "temperature").map { "residuals-$it" } +
            CauseFigures.NAMES
    }
}
