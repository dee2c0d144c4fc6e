package stillwater.diagnose.algebra

/** Sum of squares. */
internal fun squares(numbers: DoubleArray): Double {
    var sum = 0.0
    for (number in numbers) sum += number * number
    return sum
}

/** Inner product. */
internal fun dot(a: DoubleArray, b: DoubleArray): Double {
    var sum = 0.0
    for (i in a.indices) sum += a[i] * b[i]
    return sum
}

/** Inner products of [column] with each of [others], four at a time: sums that do not wait for each other. */
internal fun dots(column: DoubleArray, others: List<DoubleArray>): DoubleArray {
    val products = DoubleArray(others.size)
    for (from in others.indices step TOGETHER) {
        if (from + TOGETHER > others.size) {
            for (k in from until others.size) products[k] = dot(column, others[k])
        } else {
            dots(column, others[from], others[from + 1], others[from + 2], others[from + 3], products, from)
        }
    }
    return products
}

private const val TOGETHER = 4

private fun dots(
    column: DoubleArray,
    a: DoubleArray,
    b: DoubleArray,
    c: DoubleArray,
    d: DoubleArray,
    out: DoubleArray,
    at: Int,
) {
    var first = 0.0
    var second = 0.0
    var third = 0.0
    var fourth = 0.0
    for (i in column.indices) {
        val here = column[i]
        first += here * a[i]
        second += here * b[i]
        third += here * c[i]
        fourth += here * d[i]
    }
    out[at] = first
    out[at + 1] = second
    out[at + 2] = third
    out[at + 3] = fourth
}
