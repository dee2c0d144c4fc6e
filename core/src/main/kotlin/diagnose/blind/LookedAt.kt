package stillwater.diagnose.blind

import stillwater.diagnose.algebra.dot

/**
 * What is new in the columns of [look] beside the numbers of the model of [state], of which readings change by [own].
 *
 * The water found is smaller than the true water where noise hides it, so that what is made of it goes with the residuals
 * even where there is nothing: [waters] tell how much by chance. Of what is as all that the model shows nothing is new:
 * as water of that height it is known already. Columns of what else the sensor might show of the water are held against
 * what of them is unlike any water alone.
 */
internal class LookedAt(
    private val look: BlindLook,
    private val state: BlindState,
    own: List<DoubleArray>,
    waters: BlindWaters,
) {
    private val n = state.residuals.size

    /** Sums of the columns, independent of each other. */
    val directions: List<Looked.Direction> = run {
        val looked = Looked(state.fit, n)
        val follow = look.follow
        if (follow == null) {
            // What the boat or time makes knows nothing of the readings' errors.
            own.forEach { looked.add(it, isNew = false) }
        } else {
            // The model's own numbers are those with which nothing is left to them.
            own.forEach { column -> looked.add(column, isNew = false) { dot(it, state.whitened) } }
        }
        val chances = follow?.let { waters.chance { change -> it(change) + change } }
        if (chances != null) {
            looked.add(state.shown, isNew = true) { chances.last() }
        }
        val known = looked.directions.size
        look.columns.forEachIndexed { i, column -> looked.add(column, isNew = true) { chances?.get(i) ?: 0.0 } }
        looked.directions.drop(known)
    }

    /** [directions], whitened, less what the water takes of them. */
    val columns: List<DoubleArray> get() = directions.map { it.unlike }

    /** The heights of [directions] in the whitened residuals [z]. */
    fun heights(z: DoubleArray): List<Double> =
        directions.map { if (look.ofWater) dot(it.unlike, z) else dot(it.white, z) - it.chance }

    /** Twice the log-likelihood that directions with these [heights] gain where nothing is due to them. */
    fun gained(heights: List<Double>): Double =
        2 * directions.indices.sumOf { heights[it] * directions[it].chance } / state.variance

    /** What directions with these [heights] add, sensor units. */
    fun sum(heights: List<Double>): DoubleArray =
        DoubleArray(n) { i -> directions.indices.sumOf { heights[it] * directions[it].new[i] } }
}
