package stillwater.estimate

/** The quadratic through the seven numbers of a [ResponseBank], in steps from its middle. */
internal class QuadraticSurface {
    private val numbers = DoubleArray(ResponseBank.NODES)

    fun set(i: Int, number: Double) {
        numbers[i] = number
    }

    val slopeFirst: Double get() = (numbers[2] - numbers[1]) / 2
    val slopeSecond: Double get() = (numbers[4] - numbers[3]) / 2
    val curveFirst: Double get() = numbers[2] - 2 * numbers[0] + numbers[1]
    val curveSecond: Double get() = numbers[4] - 2 * numbers[0] + numbers[3]
    val curveBoth: Double
        get() = (numbers[6] + numbers[5] - numbers[1] - numbers[2] - numbers[3] - numbers[4]) / 2 + numbers[0]

    fun at(first: Double, second: Double): Double =
        numbers[0] + first * (slopeFirst + curveFirst * first / 2 + curveBoth * second) +
            second * (slopeSecond + curveSecond * second / 2)
}
