package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term

/**
 * Whether a log is far less likely where its truth goes on otherwise between the rows than [first] has it: what would be chosen
 * then need not be asked, which on a bench is most of the time.
 */
internal class FarBehind(private val first: Weighing, private val models: BaseModels, private val longest: Double) {
    /** Whether it is so with [steps], with all that was chosen and with nothing, each with a delay that makes up for these. */
    fun isSo(steps: Steps): Boolean =
        setOf(first.base, first.last).all { delayed(it, steps).score < first.explained - FAR }

    private fun delayed(fit: ModelFit, steps: Steps): ModelFit {
        val late = Term(Cause.DEAD_TIME, isEitherWay = true)
        val series = fit.model.series
        val terms = fit.model.terms.filter { it.key != late.key } + late
        val model = ResponseModel(series, terms, steps, models.scales(fit, steps))
        val slot = model.slot(late)
        val start = model.carried(fit.model, fit.numbers)
        start[slot] += (steps.lead - fit.model.steps.lead) * series.period
        val free = BooleanArray(start.size) { it >= ResponseModel.BASE || fit.free[it] }
        val rows = fit.noise.used
        return Fitting.fit(model, start, free, rows, longest, guess = model.noise(fit.noise, rows))
    }

    private companion object {
        /** Twice the log-likelihood that no other causes make up for. */
        const val FAR = 300.0
    }
}
