package stillwater.diagnose

import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.TestFactory
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

class DiagnosisTest {
    private val n = 700
    private val truth = DoubleArray(n) { 5 + sin(it / 9.0) + 0.7 * sin(it / 23.0 + 1) + 0.4 * sin(it / 5.7) }

    /** A log of a sensor of [stages] in the truth, with noise of 0.01 and a reading each second on a still bench. */
    private fun log(vararg stages: SensorStage): MeasuredSeries {
        val sensor = SensorSpec("hidden", stages.toList() + SensorStage.Noise(0.01)).build(truth[0], Random(7))
        val values = DoubleArray(n) { sensor.step(truth[it], 1.0, Conditions.NONE) }
        return MeasuredSeries(DoubleArray(n) { it.toDouble() }, DoubleArray(n), DoubleArray(n), values, truth)
    }

    @Test
    fun aPlainLagWithGainAndOffsetIsConsistent() {
        val result = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3))).run()
        assertEquals(Verdict.Consistent, result.verdict)
        // Six standard errors: the fit's own 95 % interval has a half width of about 0.04 s.
        assertEquals(6.0, result.baseline.parameters.first().value, 0.12)
    }

    /** Such a log is weighed twice where something is named. */
    @Test
    fun progressGrowsWhereTheReferenceIsNoisy() {
        val random = Random(8)
        val still = DoubleArray(n)
        val noisy = DoubleArray(n) { truth[it] + 0.1 * (random.nextDouble() - 0.5) }
        val told = ArrayList<Double>()
        val even = DoubleArray(n) { it.toDouble() }
        val log = MeasuredSeries(even, still, still, log(SensorStage.Asymmetric(9.0, 5.0)).values, noisy)
        Diagnosis(log, progress = told::add).run()
        assertEquals(told.sorted(), told)
        assertEquals(1.0, told.last())
        assertTrue(told.count { it < 0.5 } > 5 && told.count { it > 0.5 } > 5, "$told")
    }

    /** A path whose time constant is more than an eighth of the log: its ratio is that of the seconds beside it. */
    @Test
    fun aPathSlowerThanALogShowsIsSaidToBe() {
        val result = Diagnosis(log(SensorStage.TwoPath(5.0, 110.0, 0.05))).run()
        // What it does beyond that looks like a drift.
        val path = result.effects.firstOrNull { it.cause == Cause.TWO_PATH_RESPONSE }
        val numbers = assertNotNull(path, "${result.verdict}").parameters.associate { it.name to it.value }
        assertEquals((n - 1) / 8.0, numbers.getValue("slow_ratio") * numbers.getValue("time_constant_s"), 0.01)
        assertTrue(result.warnings.any { "as slow as is looked for" in it }, "${result.warnings}")
    }

    @Test
    fun aFewRowsAreTooFew() {
        for (rows in 5..12) {
            val few = log(SensorStage.Lag(6.0)).let { all ->
                fun first(column: DoubleArray) = column.copyOf(rows)
                MeasuredSeries(first(all.times), DoubleArray(rows), DoubleArray(rows), first(all.values), first(truth))
            }
            assertIs<Verdict.InsufficientData>(Diagnosis(few).run().verdict, "$rows rows")
        }
    }

    @Test
    fun aDriftIsNamedOrCannotBeToldFromJumps() {
        val verdict = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Drifting(1e-4))).run().verdict
        val causes = when (verdict) {
            is Verdict.Named -> verdict.causes
            is Verdict.Ambiguous -> verdict.sets.flatten()
            else -> emptyList()
        }
        assertContains(causes, Cause.DRIFT)
    }

    @Test
    fun anAsymmetryIsNamedAndTheExtendedSensorHasIt() {
        val result = Diagnosis(log(SensorStage.Asymmetric(8.0, 5.0))).run()
        assertEquals(Verdict.Named(listOf(Cause.ASYMMETRIC_RESPONSE)), result.verdict)
        val lag = assertIs<SensorStage.Asymmetric>(result.extendedSensor?.stages?.first())
        // A tenth, the bar for numbers of strong effects.
        assertEquals(8.0, lag.rising, 0.8)
        assertEquals(5.0, lag.falling, 0.5)
    }

    /** A probe let down from the air settles as it responds: with what is left of 12 units as one lag would, it "warms up". */
    @TestFactory
    fun aProbeThatComesFromFarOffSettlesAsItResponds() = listOf(
        Cause.ASYMMETRIC_RESPONSE to listOf(SensorStage.Asymmetric(8.0, 7.5)),
        Cause.TWO_PATH_RESPONSE to listOf(SensorStage.TwoPath(5.0, 30.0, 0.1)),
        Cause.SECOND_ORDER_RESPONSE to listOf(SensorStage.Lag(6.0), SensorStage.Lag(3.0)),
        Cause.HYSTERESIS to listOf(SensorStage.Lag(6.0), SensorStage.Backlash(0.1)),
    ).map { (cause, stages) ->
        dynamicTest("$cause") {
            val sensor = SensorSpec("hidden", stages + SensorStage.Noise(0.01)).build(truth[0] + 12, Random(7))
            val values = DoubleArray(n) { i ->
                // Twenty steps a row, in water that goes straight from row to row.
                val before = truth[maxOf(i - 1, 0)]
                (1..20).map { sensor.step(before + (truth[i] - before) * it / 20, 0.05, Conditions.NONE) }.last()
            }
            val times = DoubleArray(n) { it.toDouble() }
            val found = Diagnosis(MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, truth)).run()
            assertEquals(Verdict.Named(listOf(cause)), found.verdict)
        }
    }

    @Test
    fun noiseThatWandersIsInTheSensor() {
        val result = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Wander(0.02, 8.0))).run()
        val wander = result.baseSensor.stages.filterIsInstance<SensorStage.Wander>().single()
        // Ninety times 8 s: a standard error of some 10 % of the deviation.
        assertEquals(0.02, wander.standardDeviation, 0.006)
        assertEquals(8.0, wander.correlationTime, 5.0)
        val noise = result.baseSensor.stages.filterIsInstance<SensorStage.Noise>().single()
        assertEquals(0.01, noise.standardDeviation, 0.003)
    }

    @Test
    fun aWrongGivenTimeConstantIsACause() {
        val given = SensorSpec("believed", listOf(SensorStage.Lag(4.0)))
        val result = Diagnosis(log(SensorStage.Lag(6.0)), DiagnosisSettings(base = given)).run()
        assertEquals(Verdict.Named(listOf(Cause.TIME_CONSTANT)), result.verdict)
    }

    @Test
    fun aGivenSensorThatIsRightIsConsistent() {
        val given = SensorSpec("believed", listOf(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3)))
        val log = log(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3))
        assertEquals(Verdict.Consistent, Diagnosis(log, DiagnosisSettings(base = given)).run().verdict)
    }

    @Test
    fun aGivenSensorThatIsWrongInAllItsNumbersIsNamedForBoth() {
        val given = SensorSpec("believed", listOf(SensorStage.Lag(9.0), SensorStage.Calibration(0.8, 0.5)))
        val log = log(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3))
        val result = Diagnosis(log, DiagnosisSettings(base = given)).run()
        val named = assertIs<Verdict.Named>(result.verdict)
        assertEquals(
            setOf(Cause.TIME_CONSTANT, Cause.GAIN_OFFSET),
            named.causes.toSet(),
            "${result.effects} ${result.warnings} ${result.spikes.size}",
        )
        val gain = result.effects.single { it.cause == Cause.GAIN_OFFSET }.parameters.single { it.name == "gain" }
        // The noise of 0.01 over 700 rows leaves a gain's standard error below 0.001.
        assertEquals(0.9, gain.value, 0.01)
    }

    @Test
    fun twoChangesOfOneTimeConstantAreOneStageOfTheExtendedSensor() {
        val hidden = SensorStage.Combined(6.0, 1.0, 0.0, 15.0, 0.04, 1.5)
        val warmth = DoubleArray(n) { 15 + 6 * sin(it / 61.0) }
        val sensor = SensorSpec("hidden", listOf(hidden, SensorStage.Noise(0.005))).build(truth[0], Random(9))
        val values = DoubleArray(n) {
            sensor.step(truth[it], 1.0, Conditions(mapOf(Conditions.TEMPERATURE to warmth[it])))
        }
        val times = DoubleArray(n) { it.toDouble() }
        val conditions = mapOf(Conditions.TEMPERATURE to warmth)
        val log = MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, truth, conditions)
        val result = Diagnosis(log).run()
        val lag = assertIs<SensorStage.Combined>(result.extendedSensor?.stages?.first(), "${result.verdict}")
        // A tenth, the bar for numbers of strong effects.
        assertEquals(1.5, lag.risingOverFalling, 0.15)
        assertEquals(0.04, lag.relativeChange, 0.004)
    }

    /** The log of a lag in water that changes fast, with the truth of each [every]th row only. */
    private fun sparse(every: Int): MeasuredSeries {
        fun water(time: Double) = 5 + sin(time / 3) + 0.5 * sin(time / 17)
        val lag = SensorSpec("", listOf(SensorStage.Lag(6.0))).build(water(0.0), Random(0))
        val noise = java.util.Random(2)
        val shown = DoubleArray(n * every) { row ->
            // Stepped in tenths, each with the water of its middle.
            if (row == 0) return@DoubleArray water(0.0)
            (1..10).map { lag.step(water(row - 1 + (it - 0.5) / 10), 0.1, Conditions.NONE) }.last()
        }
        return MeasuredSeries(
            DoubleArray(n) { it * every.toDouble() },
            DoubleArray(n) { it * every + 3 * sin(it / 9.0) },
            DoubleArray(n),
            DoubleArray(n) { shown[it * every] + 0.002 * noise.nextGaussian() },
            DoubleArray(n) { water(it * every.toDouble()) },
            isSparse = every > 1,
        )
    }

    @Test
    @Tag("long")
    fun aReferenceTooSparseForTheWaterNamesNothing() {
        assertEquals(Verdict.Consistent, Diagnosis(sparse(1)).run().verdict)
        assertIs<Verdict.InsufficientData>(Diagnosis(sparse(7)).run().verdict)
    }

    @Test
    fun aNumberAtTheEndOfItsSearchHasAnIntervalToOneSide() {
        val delay = Diagnosis(log(SensorStage.Lag(6.0))).run().candidates.single { it.cause == Cause.DEAD_TIME }
        val estimate = delay.parameters.single { it.name == "dead_time_s" }
        val interval = assertNotNull(estimate.interval)
        assertTrue(interval.upper > estimate.value, "$estimate")
        if (estimate.value == 0.0) assertEquals(0.0, interval.lower, 0.0)
    }

    @Test
    fun outliersAreNamedAndTheirSizeIsFound() {
        val result = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Outlying(0.02, 0.5))).run()
        assertEquals(Verdict.Named(listOf(Cause.OUTLIERS)), result.verdict)
        assertTrue(result.spikes.isNotEmpty())
    }

    @Test
    fun aFewRowsAreInsufficient() {
        val few = MeasuredSeries(
            DoubleArray(30) { it.toDouble() },
            DoubleArray(30),
            DoubleArray(30),
            DoubleArray(30) { truth[it] + 0.01 * (it % 3) },
            truth.copyOf(30),
        )
        assertIs<Verdict.InsufficientData>(Diagnosis(few).run().verdict)
    }
}
