package stillwater.benchmark

import stillwater.plot.Drawing
import stillwater.plot.ErrorCurve
import stillwater.plot.ErrorCurves
import stillwater.run.Curve
import stillwater.run.ErrorSummary
import stillwater.run.ExperimentResult
import stillwater.run.Preset

/**
 * The figure of one field: mean error over moves, with bands of one standard error either way.
 *
 * @property field kind of field.
 * @property name name of its files, without ending: the report's own number where it has one.
 * @property drawing the figure.
 */
class BenchmarkFigure(val field: String, val name: String, val drawing: Drawing)

/** Draws an experiment as the report draws its Figures 6 and 7. */
object BenchmarkFigures {
    private val names = mapOf(Preset.UNIFORM to "figure-6", Preset.GAUSSIAN to "figure-7")
    private val titles = mapOf(
        Preset.UNIFORM to "Every cell drawn by itself (the report's Figure 6)",
        Preset.GAUSSIAN to "Mixture of Gaussians (the report's Figure 7)",
    )

    /** One figure for each field of [result]. */
    fun of(result: ExperimentResult): List<BenchmarkFigure> = result.settings.fields.keys.map { field ->
        BenchmarkFigure(
            field = field,
            name = names[field] ?: "errors-$field",
            drawing = ErrorCurves(
                title = titles[field] ?: field,
                subtitle = "Mean over ${result.settings.environments} environments and its standard error, " +
                    "sensor ${result.settings.sensor.name}",
                curves = result.curves.filter { it.field == field }.map(::curve),
            ),
        )
    }

    private fun curve(curve: Curve) = ErrorCurve(
        planner = curve.planner.label,
        filter = curve.filter.label,
        move = DoubleArray(curve.checkpoints.size) { curve.checkpoints[it].toDouble() },
        error = curve.doubles { mean },
        // One environment has no standard error, and so no band.
        lower = curve.doubles { mean - if (standardError.isNaN()) 0.0 else standardError },
        upper = curve.doubles { mean + if (standardError.isNaN()) 0.0 else standardError },
    )

    private fun Curve.doubles(value: ErrorSummary.() -> Double) =
        DoubleArray(summaries.size) { summaries[it].value() }
}
