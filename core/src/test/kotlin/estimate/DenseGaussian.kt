package stillwater.estimate

/** Gaussian conditioning in the plainest way: the oracle that the fast ways are compared with. */
internal object DenseGaussian {
    /** Mean and covariance of what is left. */
    class Posterior(val mean: DoubleArray, val covariance: Array<DoubleArray>)

    /**
     * Conditions N([mean], [covariance]) on [data] = [design] x + noise of variance [noise], one datum after another:
     * x ← x + P h ν / S, P ← P − P h hᵀ P / S.
     */
    fun condition(
        mean: DoubleArray,
        covariance: Array<DoubleArray>,
        design: List<DoubleArray>,
        data: DoubleArray,
        noise: DoubleArray,
    ): Posterior {
        val x = mean.copyOf()
        val p = Array(mean.size) { covariance[it].copyOf() }
        for (k in data.indices) {
            val h = design[k]
            val ph = DoubleArray(x.size) { i -> h.indices.sumOf { p[i][it] * h[it] } }
            val s = h.indices.sumOf { h[it] * ph[it] } + noise[k]
            val innovation = data[k] - h.indices.sumOf { h[it] * x[it] }
            for (i in x.indices) {
                x[i] += ph[i] * innovation / s
                for (j in x.indices) p[i][j] -= ph[i] * ph[j] / s
            }
        }
        return Posterior(x, p)
    }

    /** A row that picks unknown [i] of [size]. */
    fun pick(i: Int, size: Int): DoubleArray = DoubleArray(size).also { it[i] = 1.0 }
}
