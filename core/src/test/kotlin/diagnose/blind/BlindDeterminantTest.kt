package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.pow
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertTrue

/** Logs in which noise hides much of the water: what a fit sees of it depends on the lag. */
class BlindDeterminantTest {
    /** A winding way over water of 24 waves, seen through a lag under noise of [noise] of the water's own size. */
    private fun log(seed: Int, noise: Double): MeasuredSeries {
        println("seed $seed")
        val random = Random(seed)
        val x = DoubleArray(ROWS * STEPS)
        val y = DoubleArray(ROWS * STEPS)
        var heading = 0.0
        var turn = 0.0
        for (i in 1 until x.size) {
            if (i % STEPS == 0) turn = 0.95 * turn + 0.04 * (2 * random.nextDouble() - 1)
            heading += turn / STEPS
            x[i] = x[i - 1] + cos(heading) / STEPS
            y[i] = y[i - 1] + sin(heading) / STEPS
        }
        val waves = List(24) {
            val direction = 2 * PI * random.nextDouble()
            val number = 2 * PI / (12 + 24 * random.nextDouble())
            Triple(number * cos(direction), number * sin(direction), 2 * PI * random.nextDouble())
        }
        var shown = 0.0
        val readings = DoubleArray(x.size) { i ->
            val water = waves.sumOf { (kx, ky, phase) -> cos(kx * x[i] + ky * y[i] + phase) } / 3.5
            shown += (1 - exp(-1 / (STEPS * LAG))) * (water - shown)
            shown
        }

        fun rows(column: DoubleArray) = DoubleArray(ROWS) { column[it * STEPS + STEPS - 1] }
        val values = rows(readings)
        for (i in values.indices) {
            values[i] += 2 * noise * (random.nextDouble() + random.nextDouble() + random.nextDouble() - 1.5)
        }
        return MeasuredSeries(DoubleArray(ROWS) { it.toDouble() }, rows(x), rows(y), values, null)
    }

    @Test
    fun `is what the likelihood loses where the sensor shows water otherwise`() {
        val search = BlindSearch(log(1, 0.1))
        val state = search.best()
        val determinant = BlindDeterminant(search, state)
        val delayed = ResponseModel(state.model.series, listOf(Term(Cause.DEAD_TIME)), search.steps, search.scales)

        fun truly(terms: List<Term>, numbers: DoubleArray) =
            search.settled(terms, numbers, state.fit.design.noise, state.variances, 0, before = state)
                .fit.logDeterminant - state.fit.logDeterminant
        for (share in listOf(0.7, 0.9, 1.1, 1.5)) {
            val numbers = state.numbers.copyOf().also { it[ResponseModel.TIME_CONSTANT] *= share }
            val expected = truly(emptyList(), numbers)
            val found = determinant.at(state.model, numbers)
            assertTrue(abs(expected) > 5, "no difference to speak of at $share: $expected")
            assertTrue(abs(found - expected) < 0.15 * abs(expected), "$found for $expected at $share")
        }
        // A delay alone shows as much of the water as none.
        val late = delayed.carried(state.model, state.numbers).also { it[ResponseModel.BASE] = 0.5 }
        assertTrue(abs(truly(listOf(Term(Cause.DEAD_TIME)), late)) < 3)
        assertTrue(abs(determinant.at(delayed, late)) < 3)
    }

    @Test
    fun `a fit does not lead away from the likeliest lag`() {
        var sum = 0.0
        var weights = 0.0
        for (seed in 2..9) {
            val search = BlindSearch(log(seed, 0.1))
            val state = search.best()
            // While only what is left was made small, the next fit was worse by 2 to 4.
            val next = search.improved(state)
            assertTrue(next.score > state.score - 0.5, "${state.score} to ${next.score}, seed $seed")
            val weight = BlindErrors.of(search, state)[ResponseModel.TIME_CONSTANT].pow(-2)
            sum += weight * ln(state.timeConstant / LAG)
            weights += weight
        }
        // And lags were too short by a tenth on average.
        assertTrue(abs(sum / weights) < 0.06, "ln of the ratio ${sum / weights}")
    }

    private companion object {
        const val ROWS = 500
        const val STEPS = 10
        const val LAG = 4.0
    }
}
