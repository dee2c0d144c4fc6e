package stillwater.diagnosis

import org.hipparchus.stat.correlation.PearsonsCorrelation
import org.hipparchus.stat.descriptive.rank.Percentile
import stillwater.diagnose.ModelAssessment
import stillwater.plot.NullDistribution
import stillwater.survey.ValueResolution
import stillwater.survey.Wording.Companion.digits
import kotlin.math.ln
import kotlin.math.round
import kotlin.random.Random

/**
 * Checks of whitened residuals, each against what it would be if the model were right, by simulation.
 *
 * @param best whose residuals are looked at. @param base the model without causes, which knows nothing of rounding.
 * @param values the readings, which may be rounded, sensor units.
 */
internal class ResidualChecks(
    private val best: ModelAssessment,
    private val base: ModelAssessment,
    private val values: DoubleArray,
) {
    /** Residuals of [best] and its track that chance alone has made. */
    private val draws by lazy { draws(best) }

    /** All checks that these residuals allow; few rows allow none. */
    val all: List<ResidualCheck> by lazy {
        if (values.size < FEWEST_ROWS) {
            emptyList()
        } else {
            STATISTICS.mapNotNull { (name, of) -> check(name, best.whitened, draws, of) } + listOfNotNull(rounding())
        }
    }

    /** Of each lag from one row on, where the correlation of residuals that are right lies in 95 of 100 cases. */
    fun correlations(lags: Int): Pair<DoubleArray, DoubleArray> {
        val found = drawn(draws) { correlations(it, lags) }
        val ofLags = List(lags) { lag -> found.map { it[lag] }.toDoubleArray() }
        fun at(percent: Double) = DoubleArray(lags) { percentile(ofLags[it], percent) }
        return at(LOWER) to at(UPPER)
    }

    /** Whether the base's residuals go with what rounding does to its prediction; null where that is next to nothing. */
    private fun rounding(): ResidualCheck? {
        val step = ValueResolution.of(values).takeIf { it > FINE * base.noiseSpread } ?: return null
        val rounding = base.predicted.let { shown ->
            DoubleArray(shown.size) { round(shown[it] / step) * step - shown[it] }
        }
        val chance = if (base === best) draws else draws(base)
        return check("correlation with rounding to ${digits(step)}, base", base.whitened, chance) {
            PearsonsCorrelation().correlation(it, rounding)
        }
    }

    private fun check(
        name: String,
        whitened: DoubleArray,
        chance: List<DoubleArray>,
        of: (DoubleArray) -> Double,
    ): ResidualCheck? {
        val check = ResidualCheck(name, of(whitened), drawn(chance, of).toDoubleArray())
        return check.takeIf { it.value.isFinite() && it.chance.all(Double::isFinite) }
    }

    /** What [of] gives for each of [draws]. */
    private fun <T : Any> drawn(draws: List<DoubleArray>, of: (DoubleArray) -> T): List<T> =
        draws.parallelStream().map(of).toList()

    companion object {
        /** What is seen by chance is told by so many simulated logs. */
        private const val DRAWS = 200
        private const val SEED = 20_261_201
        private const val FEWEST_ROWS = 20
        private const val PORTMANTEAU = 20
        private const val TENTHS = 10
        private const val SMALLEST = 1e-300

        /** Of what readings scatter: rounding to less is nothing. */
        private const val FINE = 0.01

        private val STATISTICS: List<Pair<String, (DoubleArray) -> Double>> = listOf(
            "correlation of neighbours" to { correlations(it, 1)[0] },
            "whiteness (Ljung-Box over $PORTMANTEAU rows)" to ::portmanteau,
            "runs of one sign" to ::runs,
            "heaviness of the tails (excess kurtosis)" to ::kurtosis,
            "spread, largest to smallest tenth (log of variances)" to ::spread,
        )

        private fun draws(model: ModelAssessment) = model.nullResiduals.draw(DRAWS, Random(SEED))

        /** Ends of what holds 95 of 100 draws, %. */
        const val LOWER = 2.5
        const val UPPER = 97.5

        /** The [percent] % point of [sample]. */
        fun percentile(sample: DoubleArray, percent: Double): Double = Percentile().evaluate(sample, percent)

        /** Correlation of [x] with itself 1 to [lags] rows later. */
        fun correlations(x: DoubleArray, lags: Int): DoubleArray {
            val mean = x.average()
            val off = DoubleArray(x.size) { x[it] - mean }
            val all = off.sumOf { it * it }
            return DoubleArray(lags) { lag ->
                var sum = 0.0
                for (i in lag + 1 until off.size) sum += off[i] * off[i - lag - 1]
                if (all > 0) sum / all else 0.0
            }
        }

        /** After Ljung and Box, 1978, doi:10.1093/biomet/65.2.297. */
        private fun portmanteau(z: DoubleArray): Double {
            val n = z.size
            val found = correlations(z, minOf(PORTMANTEAU, n - 1))
            return n * (n + 2.0) * found.indices.sumOf { found[it] * found[it] / (n - it - 1) }
        }

        private fun runs(z: DoubleArray) = 1.0 + (1 until z.size).count { (z[it] > 0) != (z[it - 1] > 0) }

        private fun kurtosis(z: DoubleArray): Double {
            val variance = z.sumOf { it * it } / z.size
            return z.sumOf { it * it * it * it } / z.size / (variance * variance) - NORMAL_KURTOSIS
        }

        private fun spread(z: DoubleArray): Double {
            val tenth = z.size / TENTHS
            val variances = (0 until TENTHS).map { k -> (k * tenth until (k + 1) * tenth).sumOf { z[it] * z[it] } }
            return ln(maxOf(variances.max(), SMALLEST) / maxOf(variances.min(), SMALLEST))
        }

        private const val NORMAL_KURTOSIS = 3.0
    }
}

/**
 * A number that residuals have, and what it would be if the model were right.
 *
 * @property name what it is. @property value what these residuals have. @property chance what simulated ones have.
 */
internal class ResidualCheck(val name: String, val value: Double, val chance: DoubleArray) {
    /** It is above this in 97.5 of 100 cases of chance. */
    val lower: Double = ResidualChecks.percentile(chance, ResidualChecks.LOWER)

    /** It is below this as often. */
    val upper: Double = ResidualChecks.percentile(chance, ResidualChecks.UPPER)

    /** Whether it is not within what chance gives in 95 of 100 cases. */
    val isOutside: Boolean get() = value !in lower..upper

    /** It as it is drawn. */
    fun drawn() = NullDistribution(name, value, chance)
}
