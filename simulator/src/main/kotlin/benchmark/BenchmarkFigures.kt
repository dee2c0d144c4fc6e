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
    private val byField = mapOf(Preset.UNIFORM to "figure-6", Preset.GAUSSIAN to "figure-7")
    private val titles = mapOf(
        Preset.UNIFORM to "Mean error, every cell drawn by itself",
        Preset.GAUSSIAN to "Mean error, mixture of Gaussians",
    )

    /** Names of the figures' files, without ending, that any run may write. */
    val names: Collection<String> get() = byField.values

    /** One figure for each field of [result]. */
    fun of(result: ExperimentResult): List<BenchmarkFigure> = result.settings.fields.keys.map { field ->
        BenchmarkFigure(
            field = field,
            name = byField[field] ?: "errors-$field",
            drawing = ErrorCurves(
                title = titles[field] ?: field,
                subtitle = "Mean over ${result.settings.environments} environments" +
                    (if (result.settings.environments > 1) ", bands of one standard error" else "") +
                    ", sensor ${result.settings.sensor.name}",
                curves = result.curves.filter { it.field == field }.map { curve(it, result.settings.boats) },
            ),
        )
    }

    private fun curve(curve: Curve, boats: List<Int>) = ErrorCurve(
        planner = curve.planner.label + if (boats.size > 1) ", ${curve.boats} boats" else "",
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
