package stillwater.diagnose

/**
 * A look with water and noise of its own.
 *
 * @property state of the readings less what was taken for [change] before. @property change what is looked at adds to
 *   readings, length n. @property chance twice the log-likelihood that it gains where nothing is due to it.
 *   @property columns that it is a sum of, whitened and off the water. @property basis of what the model's own numbers
 *   change, likewise.
 */
internal class RefittedLook(
    val state: BlindState,
    val change: DoubleArray,
    val chance: Double,
    val columns: List<DoubleArray>,
    val basis: List<DoubleArray>,
)
