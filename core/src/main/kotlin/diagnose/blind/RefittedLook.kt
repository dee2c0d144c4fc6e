package stillwater.diagnose.blind

import stillwater.diagnose.evidence.Evidence

/**
 * A look with water and noise of its own.
 *
 * @property state of the readings less what was taken for [change] before. @property change what is looked at adds to
 *   readings, length n. @property chance twice the log-likelihood that it gains where nothing is due to it.
 *   @property columns that it is a sum of, whitened and off the water. @property own what the model's own numbers change
 *   of the readings.
 */
internal class RefittedLook(
    val state: BlindState,
    val change: DoubleArray,
    val chance: Double,
    val columns: List<DoubleArray>,
    val own: List<DoubleArray>,
) {
    /** What the model's own numbers change, whitened, off the water and independent of each other. */
    val basis: List<DoubleArray> by lazy { Evidence.orthonormal(own.map { state.fit.unlike(it) }) }

    /** How sure [change] is by [Jackknife]. */
    val sure: Double by lazy { Jackknife.t(state.fit, state.whitened, change, own) }
}
