package stillwater.diagnose

import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.EnumSource
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals

/**
 * A probe that had been in the water for a while before the first row: every part of the sensor that has a state is then
 * somewhere else, and each comes back in its own time.
 */
class OwnStartTest {
    private val truth = DoubleArray(ROWS) { water(it.toDouble()) }

    private fun water(time: Double) = 5 + sin(time / 9) + 0.7 * sin(time / 23 + 1) + 0.4 * sin(time / 5.7)

    /** A sensor of a lag and another part, whose number is [number]. */
    internal enum class Sensor(val cause: Cause, val number: Double) {
        TWO_LAGS(Cause.SECOND_ORDER_RESPONSE, 4.0),
        TWO_PATHS(Cause.TWO_PATH_RESPONSE, 0.1),
        PLAY(Cause.HYSTERESIS, 0.06),
    }

    private fun log(sensor: Sensor): MeasuredSeries {
        val random = Random(SEED)
        var first = water(-BEFORE.toDouble())
        var other = first
        val values = DoubleArray(BEFORE + ROWS) { second ->
            repeat(FINE) { k ->
                val here = water(second - BEFORE - 1 + (k + 0.5) / FINE)
                first += (1 - exp(-1 / (FINE * LAG))) * (here - first)
                when (sensor) {
                    Sensor.TWO_LAGS -> other += (1 - exp(-1 / (FINE * sensor.number))) * (first - other)
                    Sensor.TWO_PATHS -> other += (1 - exp(-1 / (FINE * SLOW))) * (here - other)
                    Sensor.PLAY -> other = other.coerceIn(first - sensor.number / 2, first + sensor.number / 2)
                }
            }
            val shown = if (sensor == Sensor.TWO_PATHS) first + sensor.number * (other - first) else other
            shown + NOISE * random.nextGaussian()
        }.copyOfRange(BEFORE, BEFORE + ROWS)
        val still = DoubleArray(ROWS)
        return MeasuredSeries(DoubleArray(ROWS) { it.toDouble() }, still, still, values, truth)
    }

    @ParameterizedTest
    @EnumSource(Sensor::class)
    internal fun whatHasAStateOfItsOwnIsNamedAlone(sensor: Sensor) {
        val result = Diagnosis(log(sensor)).run()
        assertEquals(Verdict.Named(listOf(sensor.cause)), result.verdict, "seed $SEED")
        val numbers = result.effects.single().parameters.drop(1).map { it.value }
        // The last is the share of two paths, after how slow the second is.
        assertEquals(sensor.number, numbers.last(), sensor.number / 10, "seed $SEED")
    }

    @Test
    fun aSensorThatIsGivenHasOneToo() {
        val stages = listOf(SensorStage.Lag(LAG), SensorStage.Lag(Sensor.TWO_LAGS.number))
        val given = DiagnosisSettings(base = SensorSpec("given", stages))
        assertEquals(Verdict.Consistent, Diagnosis(log(Sensor.TWO_LAGS), given).run().verdict, "seed $SEED")
    }

    private companion object {
        const val SEED = 20261127L
        const val ROWS = 700
        const val FINE = 50
        const val BEFORE = 300
        const val LAG = 5.0
        const val SLOW = 60.0
        const val NOISE = 0.005
    }
}
