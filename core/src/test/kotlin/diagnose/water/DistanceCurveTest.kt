package stillwater.diagnose.water

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.arbitrary.int
import io.kotest.property.arbitrary.numericDouble
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import kotlin.math.cos
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

class DistanceCurveTest {
    private val config = PropTestConfig(seed = 20_261, iterations = 500)

    /**
     * Waves of numbers k and heights a: a sum of a cos(k d), even about 0 as a covariance is. Between nodes h apart a
     * cubic through four of them is off by 3/128 h⁴ times the largest fourth derivative at most, which is a sum of a k⁴.
     */
    @Test
    fun itIsTheSumItStandsForUpToACubicsError() = runBlocking<Unit> {
        checkAll(config, Arb.int(), Arb.numericDouble(0.001, 0.3), Arb.numericDouble(0.0, 900.0)) {
                seed,
                step,
                places,
            ->
            val random = Random(seed)
            val numbers = DoubleArray(5) { random.nextDouble(0.0, 2.0) }
            val heights = DoubleArray(5) { random.nextDouble(0.0, 1.0) }
            fun sum(d: Double) = numbers.indices.sumOf { heights[it] * cos(numbers[it] * d) }
            val steepest = numbers.indices.sumOf { heights[it] * numbers[it] * numbers[it] * numbers[it] * numbers[it] }
            val bound = 3.0 / 128 * step * step * step * step * steepest
            val curve = DistanceCurve(step, ::sum)
            // Within the first step it leans on a node on the other side of 0; the last makes the table grow.
            for (distance in listOf(places * step, 0.0, 0.4 * step, (places + 1100) * step)) {
                // Roundings of five numbers below one.
                assertEquals(sum(distance), curve.at(distance), bound + 1e-13, "step $step at $distance, seed $seed")
            }
        }
    }

    @Test
    fun aNodeIsWorkedOutOnceAndShownAsItIs() {
        val asked = ArrayList<Double>()
        val curve = DistanceCurve(0.5) { d ->
            asked += d
            1 / (1 + d * d)
        }
        repeat(2) {
            for (i in listOf(0, 3, 1021, 1022, 5000)) assertEquals(1 / (1 + 0.25 * i * i), curve.at(0.5 * i), 1e-16)
        }
        assertEquals(asked.distinct(), asked)
    }
}
