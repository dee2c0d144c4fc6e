package stillwater.estimate

/** Searches for the greatest value of a function without its derivatives; deterministic. */
internal object Search {
    private const val GOLDEN = 0.6180339887498949

    /** Where [f] is greatest between [from] and [to], after [steps] evaluations; a maximum if there are several. */
    inline fun maximum(from: Double, to: Double, steps: Int, f: (Double) -> Double): Double {
        var a = from
        var b = to
        var left = b - GOLDEN * (b - a)
        var right = a + GOLDEN * (b - a)
        var atLeft = f(left)
        var atRight = f(right)
        repeat(steps - 2) {
            if (atLeft > atRight) {
                b = right
                right = left
                atRight = atLeft
                left = b - GOLDEN * (b - a)
                atLeft = f(left)
            } else {
                a = left
                left = right
                atLeft = atRight
                right = a + GOLDEN * (b - a)
                atRight = f(right)
            }
        }
        return if (atLeft > atRight) left else right
    }

    /**
     * Nelder and Mead's simplex, doi:10.1093/comjnl/7.4.308: where [f] is greatest near [start], each coordinate first
     * moved by [size]. At most [evaluations] of f, fewer once the simplex's values differ by less than [tolerance].
     */
    fun simplex(
        start: DoubleArray,
        size: DoubleArray,
        evaluations: Int,
        tolerance: Double,
        f: (DoubleArray) -> Double,
    ): DoubleArray {
        val n = start.size
        if (n == 0) return start
        val points = Array(n + 1) { k -> start.copyOf().also { if (k > 0) it[k - 1] += size[k - 1] } }
        val values = DoubleArray(n + 1) { f(points[it]) }
        var used = n + 1
        while (used < evaluations) {
            val order = values.indices.sortedByDescending { values[it] }
            val best = order.first()
            val worst = order.last()
            val second = order[n - 1]
            if (values[best] - values[worst] < tolerance) break
            val centre = DoubleArray(n) { i -> order.dropLast(1).sumOf { points[it][i] } / n }
            fun at(factor: Double) = DoubleArray(n) { centre[it] + factor * (points[worst][it] - centre[it]) }
            val mirrored = at(-1.0)
            val valueMirrored = f(mirrored)
            used++
            if (valueMirrored > values[best]) {
                val far = at(-2.0)
                val valueFar = f(far)
                used++
                points[worst] = if (valueFar > valueMirrored) far else mirrored
                values[worst] = maxOf(valueFar, valueMirrored)
            } else if (valueMirrored > values[second]) {
                points[worst] = mirrored
                values[worst] = valueMirrored
            } else {
                val near = if (valueMirrored > values[worst]) at(-0.5) else at(0.5)
                val valueNear = f(near)
                used++
                if (valueNear > maxOf(values[worst], valueMirrored)) {
                    points[worst] = near
                    values[worst] = valueNear
                } else {
                    for (k in order.drop(1)) {
                        for (i in 0 until n) points[k][i] = (points[k][i] + points[best][i]) / 2
                        values[k] = f(points[k])
                        used++
                    }
                }
            }
        }
        return points[values.indices.maxBy { values[it] }]
    }
}
