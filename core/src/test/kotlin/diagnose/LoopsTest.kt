package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.Combination
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.concurrent.thread
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals

/** What is done at once, or in another order, comes to the same bits as what is done in turn. */
class LoopsTest {
    private val others = mapOf(
        "two threads" to Loops { count, task ->
            var thrown: Throwable? = null
            val odd = thread { runCatching { for (i in 1 until count step 2) task(i) }.onFailure { thrown = it } }
            for (i in 0 until count step 2) task(i)
            odd.join()
            thrown?.let { throw it }
        },
        "backwards" to Loops { count, task -> for (i in count - 1 downTo 0) task(i) },
    )
    private val n = 260
    private val x = DoubleArray(n) { 15 * sin(it / 9.0) }
    private val y = DoubleArray(n) { 15 * sin(it / 13.0 + 1) }

    private val series = run {
        val truth = DoubleArray(n) { sin(x[it] / 4) + sin(y[it] / 5 + 1) }
        val stages =
            listOf(SensorStage.Lag(4.0), SensorStage.Jumps(listOf(120.0), listOf(0.3)), SensorStage.Noise(0.01))
        val sensor = SensorSpec("hidden", stages).build(truth[0], Random(SEED))
        val values = DoubleArray(n) { sensor.step(truth[it], 1.0, Conditions.NONE) }
        MeasuredSeries(DoubleArray(n) { it.toDouble() }, x, y, values, null)
    }

    @Test
    fun sumsOfColumnsAreTheSame() {
        val random = Random(SEED)
        for (count in listOf(1, 4, 7)) {
            for (rows in listOf(1, 2, 513, 1500)) {
                val columns = List(count) { DoubleArray(rows) { random.nextDouble(-1.0, 1.0) } }
                val heights = DoubleArray(count) { random.nextDouble(-1.0, 1.0) }
                val inTurn = Combination.of(columns, heights, rows, Loops.IN_TURN)
                for ((name, loops) in others) {
                    assertContentEquals(inTurn, Combination.of(columns, heights, rows, loops), "$count, $rows, $name")
                }
            }
        }
    }

    @Test
    fun theDiagonalOfAnInverseIsTheSame() {
        val random = Random(SEED)
        for (size in listOf(1, 2, 5, 33)) {
            val lower = Array(size) { i ->
                DoubleArray(i + 1) {
                    if (it ==
                        i
                    ) {
                        size + 1.0
                    } else {
                        random.nextDouble(-1.0, 1.0)
                    }
                }
            }
            val factor = Cholesky(lower)
            for ((name, loops) in others) {
                assertContentEquals(factor.inverseDiagonal(), factor.inverseDiagonal(loops), "$size, $name")
            }
        }
    }

    /** The whole search without a reference: its designs, whitened columns, products and what they led to. */
    @Test
    @Tag("long")
    fun aDiagnosisWithoutAReferenceIsTheSame() {
        fun found(loops: Loops) = Diagnosis(series, loops = loops).run()
        val inTurn = found(Loops.IN_TURN)
        for ((name, loops) in others) {
            val other = found(loops)
            assertEquals(inTurn.verdict, other.verdict, name)
            assertEquals(inTurn.baseline.parameters, other.baseline.parameters, name)
            assertContentEquals(inTurn.baseline.predicted, other.baseline.predicted, name)
            assertEquals(inTurn.extended?.parameters, other.extended?.parameters, name)
        }
    }

    private companion object {
        const val SEED = 20261122
    }
}
