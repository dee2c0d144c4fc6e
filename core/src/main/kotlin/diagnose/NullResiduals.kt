package stillwater.diagnose

import stillwater.model.Conditions
import stillwater.sensor.GaussianNoise
import kotlin.random.Random

/**
 * Draws whitened residuals as they would be if the model were right: the simulated null of checks of residuals.
 *
 * Where only a few numbers were fitted these are independent normal numbers. Where the water was inferred from the same
 * log they are correlated and quieter, since the water has taken a part of the noise: checks against independent numbers
 * find structure in every such log. See core/docs/Diagnosis.md, (12d).
 */
public fun interface NullResiduals {
    /** As many as [count] draws by [random], each one number a row, in standard deviations of the noise. */
    public fun draw(count: Int, random: Random): List<DoubleArray>
}

/** The same of the [rows] alone, which ascend. */
internal fun NullResiduals.of(rows: IntArray) =
    NullResiduals { count, random -> draw(count, random).map { all -> DoubleArray(rows.size) { all[rows[it]] } } }

/** Residuals that are independent on the rows [used], and 0 on others. */
internal fun independentResiduals(used: BooleanArray) = NullResiduals { count, random ->
    List(count) { standardNormal(used.size, random).also { z -> for (i in z.indices) if (!used[i]) z[i] = 0.0 } }
}

/** As many as [count] independent normal numbers of variance 1. */
internal fun standardNormal(count: Int, random: Random): DoubleArray {
    val noise = GaussianNoise(1.0, random)
    return DoubleArray(count) { noise.step(0.0, 1.0, Conditions.NONE) }
}
