package stillwater.reproduction

import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.TestInstance
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.estimate.SelfCalibratingSettings
import stillwater.estimate.SensorKind
import stillwater.plan.Lawnmower
import stillwater.plan.SettlingLawnmower
import stillwater.run.Preset
import stillwater.run.Trial
import stillwater.sensor.FirstOrderLag
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.world.Seeds
import kotlin.test.Test
import kotlin.test.assertTrue

/**
 * What is known of the water through a sensor of which nobody told even the kind: the bars of docs/results.md, on other
 * seeds than those it was worked out on.
 */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class SensorChoiceTest {
    private val settings = Preset.NOISY.settings()
    private val seeds = Seeds(SEED)
    private val lag = SensorStage.Lag(timeConstant(0.1))
    private val noise = listOf(SensorStage.Noise(0.002), SensorStage.Quantum(0.005))

    private fun timeConstant(alpha: Double) = FirstOrderLag.timeConstant(alpha, period = 1.0)

    /**
     * Means over environments: the [error]; [errors] of a right prior and of priors 3 times too long and too short,
     * over the same third of the environments.
     */
    private class Outcome(
        val error: Double,
        val errors: List<Double>,
        val covered: Double,
        val chosen: Map<SensorKind, Int>,
    ) {
        override fun toString() = "error $error, by prior $errors, covered $covered, chosen $chosen"
    }

    private val asymmetric by lazy {
        val stage = SensorStage.Asymmetric(timeConstant(0.13), timeConstant(0.07))
        listOf(Preset.UNIFORM, Preset.GAUSSIAN).map { run(it, listOf(stage), moves = 100, environments = 60) }
    }
    private val deadTime by lazy {
        val stages = listOf(SensorStage.Delay(2.0), lag)
        listOf(Preset.UNIFORM, Preset.GAUSSIAN).map { run(it, stages, moves = 100, environments = 60) }
    }
    private val secondOrder by lazy {
        listOf(run(Preset.UNIFORM, listOf(lag, lag), moves = 200, environments = 60))
    }
    private val slewLimit by lazy {
        listOf(run(Preset.UNIFORM, listOf(SensorStage.Slew(0.01)), moves = 500, environments = 40))
    }

    private fun run(
        kind: String,
        stages: List<SensorStage>,
        moves: Int,
        environments: Int,
        wrongPriors: Boolean = true,
        waits: Boolean = true,
    ): Outcome {
        val errors = DoubleArray(3)
        var sum = 0.0
        var covered = 0
        val chosen = ArrayList<SensorKind>()
        for (environment in 0 until environments) {
            for ((i, factor) in listOf(1.0, 3.0, 1.0 / 3).withIndex()) {
                // Wrong priors on every third environment: they are held against the same environments.
                if (i > 0 && (environment % 3 != 0 || !wrongPriors)) continue
                val estimator = SelfCalibratingEstimator(
                    settings.grid,
                    settings.prior,
                    SelfCalibratingSettings(factor * lag.timeConstant, factor = 3.0),
                )
                val error = survey(kind, stages, estimator, moves, environment, waits)
                if (i > 0 || environment % 3 == 0) errors[i] += error
                if (i > 0) continue
                val field = settings.fields.getValue(kind).draw(settings.grid, seeds.random("field $kind", environment))
                covered += (0 until settings.grid.size).count {
                    field.truth(it) in estimator.map.lower(it)..estimator.map.upper(it)
                }
                chosen += estimator.sensor().chosen.kind
                sum += error
            }
        }
        val few = (environments + 2) / 3
        val cells = environments.toDouble() * settings.grid.size
        val counts = chosen.groupingBy { it }.eachCount()
        return Outcome(sum / environments, errors.map { it / few }, covered / cells, counts)
    }

    private fun survey(
        kind: String,
        stages: List<SensorStage>,
        estimator: SelfCalibratingEstimator,
        moves: Int,
        environment: Int,
        waits: Boolean,
        seeds: Seeds = this.seeds,
        stream: String = "noise",
    ): Double {
        val field = settings.fields.getValue(kind).draw(settings.grid, seeds.random("field $kind", environment))
        val spec = SensorSpec("sensor", stages + noise)
        val sensor = spec.build(field.truth(0), seeds.random(stream, environment))
        val pattern = settings.plannerSettings.pattern
        val isLimited = waits && stages.any { it is SensorStage.Slew }
        val planner = if (isLimited) SettlingLawnmower(pattern) else Lawnmower(pattern)
        return Trial(field, sensor, planner, listOf(estimator), settings.samplesPerMove, settings.period)
            .run(start = 0, intArrayOf(moves)).single().mean.single()
    }

    private fun assertBar(outcomes: List<Outcome>, bar: Double, kind: SensorKind) {
        for (outcome in outcomes) {
            assertTrue(outcome.error <= bar, "$outcome")
            // Errors of the same environments, paired: the prior may cost a tenth.
            for (error in outcome.errors) assertTrue(error <= 1.1 * outcome.errors[0], "$outcome")
            // Issue 3's bar.
            assertTrue(outcome.covered in 0.93..0.97, "$outcome")
            // In a field without contrast one survey in fifty may not show the difference.
            val right = outcome.chosen.getOrDefault(kind, 0)
            assertTrue(right >= 0.95 * outcome.chosen.values.sum(), "$outcome")
        }
    }

    @Test
    fun readsAnAsymmetricSensor() = assertBar(asymmetric, bar = 0.006, SensorKind.ASYMMETRIC)

    @Test
    @Tag("long")
    fun readsASensorWithADeadTime() = assertBar(deadTime, bar = 0.006, SensorKind.DEAD_TIME)

    @Test
    fun readsASensorOfSecondOrder() = assertBar(secondOrder, bar = 0.010, SensorKind.SECOND_ORDER)

    /**
     * Of which twice the variance was believed once, and 98 to 99 % held. Errors of a survey's cells hang together: 60
     * surveys tell the share to 0.012, and four such deviations below 0.95 are allowed.
     */
    @Test
    fun intervalsOfTwoUnlikeLagsAreAsWideAsTheyShouldBe() {
        val third = SensorStage.Lag(lag.timeConstant / 3)
        val outcome = run(Preset.UNIFORM, listOf(lag, third), moves = 100, environments = 60, wrongPriors = false)
        assertTrue(outcome.covered in 0.90..0.97, "$outcome")
    }

    /**
     * What every visit is believed to find pulled them together once, the more the longer the survey: half of the
     * intervals held, errors were 0.014. Errors of a survey's cells hang together: 20 surveys tell the share to 0.02.
     */
    @Test
    fun intervalsOfTwoUnlikeLagsLongerThanAStayHoldInALongSurvey() {
        val stages = listOf(SensorStage.Lag(6.2), SensorStage.Lag(19.5))
        val outcome = run(Preset.UNIFORM, stages, moves = 1000, environments = 20, wrongPriors = false)
        assertTrue(outcome.covered >= 0.88, "$outcome")
        assertTrue(outcome.error <= 0.009, "$outcome")
    }

    /**
     * Together no longer than a stay. While the valley of the misfit was taken for straight, 0.63 of the intervals held
     * (0.94 now), and errors were three times as large.
     */
    @Test
    fun intervalsOfTwoFastLagsHold() {
        val fast = SensorStage.Lag(lag.timeConstant / 2)
        val outcome = run(Preset.UNIFORM, listOf(fast, fast), moves = 500, environments = 20, wrongPriors = false)
        assertTrue(outcome.covered >= 0.80, "$outcome")
        assertTrue(outcome.error <= 0.003, "$outcome")
    }

    @Test
    fun readsASlewLimitedSensorWhenItWaitsForIt() = assertBar(slewLimit, bar = 0.005, SensorKind.SLEW_LIMIT)

    /**
     * Most cells are never reached. While their whole range counted, too many held; it hid that 0.87 of the others did, of
     * which some were believed reached for a chance reading.
     */
    @Test
    fun intervalsBehindASlewLimitThatTheBoatOutrunsHold() {
        for (kind in listOf(Preset.UNIFORM, Preset.GAUSSIAN)) {
            val stages = listOf(SensorStage.Slew(0.01))
            val outcome = run(kind, stages, moves = 500, environments = 40, wrongPriors = false, waits = false)
            assertTrue(outcome.covered in 0.93..0.97, "$kind $outcome")
        }
    }

    /**
     * Little contrast about the start: a fit of a fast lag leaves less correlation than speaks against a model, but more
     * than it takes once one was flagged. While only the former counted no slew limit was tried, nothing explained the
     * readings, and the boat stayed as long as it may in each cell: errors were 0.12 to 0.17. Fields and noise are those of
     * `benchmark`.
     */
    @Test
    fun aSlewLimitIsTriedWhereALagWasFlaggedAndNoLongerClearlyFails() {
        for ((seed, environment) in listOf(20_263_102L to 47, 20_263_203L to 39, 20_263_205L to 3)) {
            val estimator = SelfCalibratingEstimator(
                settings.grid,
                settings.prior,
                SelfCalibratingSettings(timeConstant = 3.16, factor = 3.0),
            )
            val error = survey(
                Preset.GAUSSIAN,
                listOf(SensorStage.Slew(0.01)),
                estimator,
                moves = 500,
                environment,
                waits = true,
                Seeds(seed),
                stream = "noise ${Preset.GAUSSIAN} settling-lawnmower self-calibrating",
            )
            assertTrue(error <= 0.005, "seed $seed, environment $environment: $error")
            assertTrue(estimator.sensor().chosen.kind == SensorKind.SLEW_LIMIT, "$seed: ${estimator.sensor()}")
        }
    }

    @Test
    fun readsTheSlewLimitOfTheOriginalExperiment() {
        val original = Preset.ORIGINAL.settings()
        for (kind in listOf(Preset.UNIFORM, Preset.GAUSSIAN)) {
            val errors = (0 until 20).map { environment ->
                val random = seeds.random("field $kind", environment)
                val field = original.fields.getValue(kind).draw(original.grid, random)
                val sensor = original.sensor.build(field.truth(0), seeds.random("noise", environment))
                val estimator = SelfCalibratingEstimator(original.grid, original.prior)
                val planner = SettlingLawnmower()
                Trial(field, sensor, planner, listOf(estimator), original.samplesPerMove, original.period)
                    .run(start = 0, intArrayOf(500)).single().mean.single()
            }
            // Issue 3's bar; 0.00002 was found.
            assertTrue(errors.average() <= 0.005, "$kind $errors")
        }
    }

    private companion object {
        /** Fixed before the first run; not a seed that the estimator was worked out on. */
        const val SEED = 20_261_125L
    }
}
