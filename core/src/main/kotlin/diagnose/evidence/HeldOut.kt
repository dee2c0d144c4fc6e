package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import kotlin.math.PI
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * How well a model predicts rows it was not fitted to.
 *
 * @property rmse root mean square of the residuals, sensor units. @property logLikelihood of those rows, natural
 * logarithm, under the noise model.
 */
internal data class HeldOutScore(val rmse: Double, val logLikelihood: Double)

/** Cross-validation over blocks of the log: each fold holds out every fourth of 16 stretches. */
internal object HeldOut {
    private const val FOLDS = 4
    private const val STRETCHES = 16

    /**
     * The score of [fit]'s model; each fold is fitted anew from [fit]'s numbers under its noise. [stretches] says which of
     * the stretches each row is in; without it they are equally long.
     */
    fun score(
        fit: ModelFit,
        used: BooleanArray,
        stretches: IntArray = IntArray(used.size) { it * STRETCHES / used.size },
    ): HeldOutScore {
        val n = used.size
        // Only the first stretch shows what the sensor had seen before the log: it stays as it was found.
        val free = fit.free.copyOf().also { free -> fit.model.firstStates.forEach { free[it] = false } }
        var squareSum = 0.0
        var rows = 0
        var likelihood = 0.0
        for (fold in 0 until FOLDS) {
            val held = BooleanArray(n) { used[it] && stretches[it] % FOLDS == fold }
            val trained = BooleanArray(n) { used[it] && !held[it] }
            val times = fit.model.series.times
            val train = fit.noise.over(trained)
            val refit = Fitting.fit(fit.model, fit.numbers, free, trained, fit.noise.time, noise = train)
            val test = fit.noise.over(held)
            val z = DoubleArray(n)
            test.whiten(refit.residuals, z)
            for (i in 0 until n) if (held[i]) squareSum += refit.residuals[i] * refit.residuals[i]
            rows += test.rows
            val variance = maxOf(refit.variance, 1e-300)
            likelihood += -0.5 * (test.rows * ln(2 * PI * variance) + test.logDeterminant + squares(z) / variance)
        }
        return HeldOutScore(sqrt(squareSum / maxOf(rows, 1)), likelihood)
    }

    /**
     * By how much more of the log-likelihood [fit] foretells than [base] where its terms act now and then only, as an end of
     * the range does: who has not seen it act cannot foretell it. So each stretch has its part of what [fit]'s terms explain
     * beyond [root], which has none.
     */
    fun gainWhereTheyAct(fit: ModelFit, base: ModelFit, root: ModelFit, used: BooleanArray): Double {
        val n = used.size
        val changes = DoubleArray(n) { if (used[it]) fit.residuals[it] - root.residuals[it] else 0.0 }
        val total = squares(changes)
        if (!(total > 0)) return 0.0
        var sum = 0.0
        val stretches = IntArray(n) { i ->
            sum += (changes[i] * changes[i] / total + 1.0 / n) / 2
            minOf((sum * STRETCHES).toInt(), STRETCHES - 1)
        }
        return score(fit, used, stretches).logLikelihood - score(base, used, stretches).logLikelihood
    }
}
