package stillwater.diagnose.blind

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.ChannelLags
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.util.stream.IntStream
import kotlin.math.PI
import kotlin.math.expm1
import kotlin.math.sin
import kotlin.math.tanh
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertIs
import kotlin.test.assertTrue

class BlindDiagnosisTest {
    private val n = 900
    private val track = CrossingTrack(n)

    private val x = track.x
    private val y = track.y
    private val truth = track.truth

    private fun log(vararg stages: SensorStage, scale: Double = 1.0): MeasuredSeries {
        val sensor = SensorSpec("hidden", stages.toList() + SensorStage.Noise(0.004)).build(truth[0], Random(7))
        val values = DoubleArray(n) { scale * sensor.step(truth[it], 1.0, Conditions.NONE) }
        return MeasuredSeries(DoubleArray(n) { it.toDouble() }, x, y, values, null)
    }

    /** A lag of 5 s of which a simulation takes one step a row, by the truth so many rows [late]. */
    private fun stepped(late: Int): DoubleArray {
        val random = java.util.Random(8)
        var reading = truth[0]
        return DoubleArray(n) { i ->
            if (i > 0) reading += -expm1(-1 / 5.0) * (truth[i - late] - reading)
            reading + 0.004 * random.nextGaussian()
        }
    }

    private fun causes(verdict: Verdict): List<Cause> = when (verdict) {
        is Verdict.Named -> verdict.causes
        is Verdict.Ambiguous -> verdict.sets.flatten()
        else -> emptyList()
    }

    @Test
    fun aPlainLagIsFoundAndNothingElseIsNamed() {
        val result = Diagnosis(log(SensorStage.Lag(5.0))).run()
        assertTrue(causes(result.verdict).all { it in LAG }, "${result.verdict}")
        // The sensor holds its input over a step, which is half a step less of a delay.
        assertEquals(5.0, result.baseline.parameters.first().value, 0.7)
    }

    @Test
    fun anAsymmetryIsNamedWithoutAReference() {
        val verdict = Diagnosis(log(SensorStage.Asymmetric(7.0, 4.0))).run().verdict
        assertContains(causes(verdict), Cause.ASYMMETRIC_RESPONSE)
    }

    /** Threads share designs, models and their columns; what is found first must not matter. */
    @Test
    fun theAnswerIsTheSameWhateverIsDoneAtOnce() {
        val series = log(SensorStage.Asymmetric(7.0, 4.0))
        val inTurn = Diagnosis(series).run()
        val atOnce = Diagnosis(series, loops = AT_ONCE).run()
        assertEquals(inTurn.verdict, atOnce.verdict)
        assertEquals(inTurn.dependences, atOnce.dependences)
        assertEquals(inTurn.candidates.size, atOnce.candidates.size)
        for ((one, other) in inTurn.candidates.zip(atOnce.candidates)) {
            assertEquals(one.parameters, other.parameters, "${one.cause}")
            assertEquals(one.pValue, other.pValue, "${one.cause}")
        }
        assertEquals(inTurn.baseline.heldOutRmse, atOnce.baseline.heldOutRmse)
    }

    /** What the time goes with: designs, and loops over their rows and columns. */
    @Test
    fun noMoreIsAskedThanItTakes() {
        var loops = 0
        val counted = Loops { count, task ->
            loops++
            repeat(count, task)
        }
        val diagnosis = BlindDiagnosis(log(SensorStage.Lag(5.0)), DiagnosisSettings(), counted)
        diagnosis.run()
        assertTrue(diagnosis.search.designs.made <= MOST_DESIGNS, "${diagnosis.search.designs.made} designs")
        assertTrue(loops <= MOST_LOOPS, "$loops loops")
    }

    @Test
    fun noiseThatWasFarBehindIsNotAskedAgainNearBy() {
        var loops = 0
        val counted = Loops { count, task ->
            loops++
            repeat(count, task)
        }
        val series = log(SensorStage.Lag(5.0))
        val search = BlindSearch(series, counted)
        fun noise(share: Double, rows: Double) = CorrelatedNoise(series.times, share, rows * series.period, search.used)
        val own = BlindNoise(noise(0.5, 10.0), DoubleArray(n) { 1.0 })
        fun state(lag: Double, before: BlindState?) =
            search.settled(emptyList(), doubleArrayOf(lag, 1.0, 0.0, 0.0), own, DoubleArray(0), before = before)
        val state = state(5.0, before = null)
        val others = listOf(noise(0.2, 10.0), noise(0.8, 10.0), noise(0.5, 3.0), noise(0.5, 35.0))
        others.forEach { state.learn(it, 150.0) }
        loops = 0
        search.requieted(state)
        assertEquals(0, loops)
        assertTrue(others.all(state(5.01, before = state)::isFarBehind))
        // Twice that lag is less likely by far: it may be at home under another noise.
        assertFalse(others.any(state(10.0, before = state)::isFarBehind))
        others.forEach { state.learn(it, 90.0) }
        assertFalse(others.any(state::isFarBehind))
    }

    @Test
    @Tag("long")
    fun whatTheHalvesContradictIsNotNamed() {
        val early = log(SensorStage.Asymmetric(9.0, 3.0)).values
        val late = log(SensorStage.Asymmetric(4.8, 4.2)).values
        val values = DoubleArray(n) { if (it < n / 2) early[it] else late[it] }
        val times = DoubleArray(n) { it.toDouble() }
        val verdict = Diagnosis(MeasuredSeries(times, x, y, values, null)).run().verdict
        assertIs<Verdict.Unexplained>(verdict)
        assertContains(verdict.what, "halves")
    }

    @Test
    fun aJumpOfTheOffsetIsNamedWithoutAReference() {
        val verdict = Diagnosis(log(SensorStage.Lag(4.0), SensorStage.Jumps(listOf(250.0), listOf(0.3)))).run().verdict
        assertContains(causes(verdict), Cause.OFFSET_STEPS)
    }

    @Test
    fun aGivenLagIsACauseWhereItIsWrongAndNoneWhereItIsRight() {
        val log = log(SensorStage.Lag(5.0))
        fun answer(tau: Double): Verdict {
            val given = SensorSpec("believed", listOf(SensorStage.Lag(tau)))
            return Diagnosis(log, DiagnosisSettings(base = given)).run().verdict
        }
        assertContains(causes(answer(2.0)), Cause.TIME_CONSTANT)
        val own = Diagnosis(log).run().baseline.parameters.first().value
        assertEquals(Verdict.Consistent, answer(own))
    }

    /** The simulator's truth is held over a step, half a step ahead of one that goes on: beside wild readings, too. */
    @Test
    fun wildReadingsDoNotMakeAHeldTruthAShift() {
        val lagged = log(SensorStage.Lag(5.0))
        val wild = DoubleArray(n) { lagged.values[it] + if (it % 97 == 50) 3.0 else 0.0 }
        val result = Diagnosis(MeasuredSeries(lagged.times, x, y, wild, null)).run()
        assertEquals(Verdict.Named(listOf(Cause.OUTLIERS)), result.verdict)
        assertEquals(5.0, result.baseline.parameters.first().value, 0.2)
    }

    /** Half a step behind a truth that goes on evenly. */
    @Test
    fun aTruthThatIsHeldUntilTheNextRowIsNoDeadTime() {
        val result = Diagnosis(MeasuredSeries(track.times, x, y, stepped(late = 1), null)).run()
        assertEquals(Verdict.Consistent, result.verdict)
        assertEquals(5.0, result.baseline.parameters.first().value, 0.2)
        assertContains(result.warnings.joinToString(" "), "held from each row until the next")
    }

    /** Two lags, each of which a simulation in steps has half a row sooner: that shows only once both are in the model. */
    @Test
    @Tag("long")
    fun twoLagsInStepsAreNamed() {
        val random = java.util.Random(9)
        var first = truth[0]
        var reading = first
        val values = DoubleArray(n) { i ->
            first += -expm1(-1 / 9.0) * (truth[i] - first)
            reading += -expm1(-1 / 6.0) * (first - reading)
            reading + 0.001 * random.nextGaussian()
        }
        val result = Diagnosis(MeasuredSeries(track.times, x, y, values, null)).run()
        assertEquals(Verdict.Named(listOf(Cause.SECOND_ORDER_RESPONSE)), result.verdict, "${result.warnings}")
    }

    /** Clear, and no more than fixes and clocks may be off: as with a reference it is named, and that is said. */
    @Test
    fun aShiftOfLessThanATenthOfARowIsNamedWithACaution() {
        val result = Diagnosis(shifted(-0.08)).run()
        assertTrue(causes(result.verdict).any { it in BlindTerms.OF_LAG }, "${result.verdict}")
        assertContains(result.warnings.joinToString(" "), "a shift of less than a tenth of a row")
    }

    /** No more than a simulation of twenty steps a row makes. */
    @Test
    fun aShiftOfNextToNothingIsNotNamed() {
        val verdict = Diagnosis(shifted(-0.025)).run().verdict
        assertTrue(causes(verdict).none { it in BlindTerms.OF_LAG }, "$verdict")
    }

    /** A second path whose share of the readings may as well be none makes up for it, at a time that is known. */
    @Test
    @Tag("long")
    fun aProbeThatIsHardlyAheadHasNoSecondPath() {
        val verdict = Diagnosis(shifted(0.07)).run().verdict
        assertFalse(Cause.TWO_PATH_RESPONSE in causes(verdict), "$verdict")
    }

    /** Readings of the water [ahead] s later, through a lag of 5 s. */
    private fun shifted(ahead: Double): MeasuredSeries {
        val parts = 20
        val random = java.util.Random(7)
        var reading = truth[0]
        val values = DoubleArray(n) { i ->
            repeat(parts) { k ->
                val at = i - 1 + (k + 0.5) / parts + ahead
                val east = 15 * sin(at / 19)
                val north = 15 * sin(at / 25 + 1)
                val water = sin(east / 4) + sin(north / 5 + 1) + sin((east + north) / 7)
                reading += -expm1(-1 / (parts * 5.0)) * (water - reading)
            }
            reading + 0.002 * random.nextGaussian()
        }
        return MeasuredSeries(track.times, x, y, values, null)
    }

    @Test
    @Tag("long")
    fun aLagIsSaidBesideWhatNoCauseExplains() {
        val late = log(SensorStage.Delay(5.0))
        val hum = DoubleArray(n) { late.values[it] + 1.0 * sin(2 * PI * late.times[it] / 7) }
        val result = Diagnosis(MeasuredSeries(late.times, x, y, hum, null)).run()
        val verdict = result.verdict
        assertIs<Verdict.Unexplained>(verdict, "${result.dependences} ${result.warnings}")
        val said = Regex("period of ([0-9.]+) s").find(verdict.what)?.groupValues?.get(1)?.toDouble()
        // Half of what the log tells apart.
        assertEquals(7.0, said ?: 0.0, 7.0 * 7 / (2 * n), verdict.what)
        assertEquals(listOf(LAG), verdict.ambiguity)
    }

    /** Casts up and down through water that heaves from cast to cast, as a float's. */
    private fun casts(lag: Double): MeasuredSeries {
        val rows = 80
        val random = Random(11)
        val depth = DoubleArray(CASTS * rows) { i ->
            val way = 2.0 + 1.0 * (i % rows)
            if (i / rows % 2 == 0) way else 2.0 + rows - way + 2.0
        }
        val heave = DoubleArray(CASTS) { 3 * random.nextDouble(-1.0, 1.0) }
        val times = DoubleArray(depth.size) { 25.0 * it }
        val water = DoubleArray(depth.size) { i -> 200 - 40 * tanh((depth[i] - 40 - heave[i / rows]) / 6) }
        val sensor = SensorSpec("float", listOf(SensorStage.Lag(lag), SensorStage.Noise(0.05))).build(water[0], random)
        val values = DoubleArray(depth.size) { sensor.step(water[it], 25.0, Conditions.NONE) }
        return MeasuredSeries(times, depth, DoubleArray(depth.size), values, null)
    }

    @Test
    fun aLagShowsInCastsThroughWaterThatHeaves() {
        val result = Diagnosis(casts(lag = 60.0)).run()
        assertTrue(causes(result.verdict).all { it in LAG }, "${result.verdict}")
        assertContains(result.warnings.joinToString(" "), "The readings lag the water")
        // The sensor holds its input over a step, which is half a step less of a delay.
        assertEquals(60.0, result.baseline.parameters.first().value, 15.0)
    }

    @Test
    fun noiseLookedForAnewIsNeverLessLikely() {
        val search = BlindSearch(casts(lag = 60.0))
        val state = search.best()
        for (next in listOf(search.evened(state), search.quieted(state), search.requieted(state))) {
            assertTrue(next.score >= state.score, "${next.score} after ${state.score}")
        }
    }

    @Test
    fun readingsTooSmallToReckonWithAreTooLittle() {
        assertIs<Verdict.InsufficientData>(Diagnosis(log(SensorStage.Lag(5.0), scale = 1e-200)).run().verdict)
    }

    /** Nothing but smoothness would tell the water's changes from the sensor's there. */
    @Test
    fun aTowThatNeverComesBackIsTooLittle() {
        val line = DoubleArray(n) { 0.8 * it }
        val bent = DoubleArray(n) { 40 * sin(it / 200.0) }
        val water = DoubleArray(n) { sin(line[it] / 7) + sin(line[it] / 15 + 1) }
        val sensor = SensorSpec(
            "hidden",
            listOf(SensorStage.Lag(5.0), SensorStage.Noise(0.004)),
        ).build(water[0], Random(7))
        val values = DoubleArray(n) { sensor.step(water[it], 1.0, Conditions.NONE) }
        val times = DoubleArray(n) { it.toDouble() }
        val tow = Diagnosis(MeasuredSeries(times, line, bent, values, null)).run()
        assertContains(assertIs<Verdict.InsufficientData>(tow.verdict).why, "no pass comes within")
        assertEquals(emptyList(), tow.spikes)
        // Wild readings need no second pass to show.
        val wild = listOf(100, 230, 377, 512, 640)
        wild.forEach { values[it] += 0.2 }
        val spiky = Diagnosis(MeasuredSeries(times, line, bent, values, null)).run()
        assertIs<Verdict.InsufficientData>(spiky.verdict)
        assertEquals(wild, spiky.spikes)
        assertContains(spiky.warnings, "5 single readings are far off the readings beside.")
    }

    /** Of the lag nothing is told there, but digits and a logger that hangs show in the readings. */
    @Test
    fun aTowThatNeverComesBackTellsOfRoundingAndOfALoggerThatHung() {
        val line = DoubleArray(n) { 0.8 * it }
        val random = java.util.Random(7)
        val clean = DoubleArray(n) { sin(line[it] / 7) + sin(line[it] / 15 + 1) + 0.004 * random.nextGaussian() }
        val times = DoubleArray(n) { it.toDouble() }
        fun warnings(values: DoubleArray): List<String> {
            val tow = Diagnosis(MeasuredSeries(times, line, DoubleArray(n), values, null)).run()
            assertIs<Verdict.InsufficientData>(tow.verdict)
            return tow.warnings
        }
        assertEquals(emptyList(), warnings(clean))
        val coarse = DoubleArray(n) { 0.05 * Math.rint(clean[it] / 0.05) }
        assertContains(
            warnings(coarse),
            "Rounding to steps of 0.0500 is most of what the readings scatter from row to row.",
        )
        val hung = DoubleArray(n) { if (it in 300..340) clean[300] else clean[it] }
        assertContains(
            warnings(hung),
            "The readings stand still to the last digit for 41 rows, once: the sensor or the logger hung.",
        )
    }

    /** Two places far apart, at which the boat mostly stands: the shortest waves would be a millionth of the way. */
    @Test
    @Tag("long")
    fun stationsWithRepeatedFixesAreAnswered() {
        val random = Random(11)
        val east = DoubleArray(n) { i ->
            (if (i / 100 % 2 == 0) 0.0 else 5000.0) +
                if (i % 10 == 0) random.nextDouble() else 0.5
        }
        val north = DoubleArray(n) { i -> if (i % 10 == 0) random.nextDouble() else 0.5 }
        val values = DoubleArray(n) { i -> (if (i / 100 % 2 == 0) 8.0 else 9.0) + 0.01 * random.nextDouble() }
        Diagnosis(MeasuredSeries(DoubleArray(n) { it.toDouble() }, east, north, values, null)).run()
    }

    @Test
    fun waterThatHoldsNothingIsAnswered() {
        val random = Random(12)
        val noise = DoubleArray(n) { 8 + 0.01 * (random.nextDouble() - random.nextDouble()) }
        val verdict = Diagnosis(MeasuredSeries(DoubleArray(n) { it.toDouble() }, x, y, noise, null)).run().verdict
        assertTrue(causes(verdict).isEmpty(), "$verdict")
    }

    @Test
    fun aNumberAtTheEndOfTheSearchHasAnOpenInterval() {
        val result = Diagnosis(log(SensorStage.Noise(0.004))).run()
        val tau = result.baseline.parameters.first()
        assertEquals(0.0, checkNotNull(tau.interval).lower, 0.05)
        assertTrue(checkNotNull(tau.interval).upper > tau.value)
    }

    @Test
    fun whatTwoChannelsLagAlikeIsToldFromTheSensorsOwn() {
        val slow = log(SensorStage.Delay(6.0))
        val quick = log(SensorStage.Delay(2.0))
        val lags = ChannelLags.of(slow, "oxygen", mapOf("temperature" to quick.values))
        // Half a second: rows are a second apart.
        assertEquals(2.0, checkNotNull(lags.common), 0.5)
        assertEquals(4.0, checkNotNull(lags.own), 0.5)
    }

    /** Two simulations of one lag, of which one has each truth a step later. */
    @Test
    fun whatHeldStepsAddIsInTheLagsOfChannels() {
        val series = MeasuredSeries(track.times, x, y, stepped(late = 1), null)
        val lags = ChannelLags.of(series, "late", mapOf("prompt" to stepped(late = 0)))
        assertEquals(1.0, checkNotNull(lags.own), 0.3)
    }

    private companion object {
        const val CASTS = 10
        val LAG = listOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME)

        /** A few more than there are: sums in another order may make a step more or less. */
        const val MOST_DESIGNS = 75
        const val MOST_LOOPS = 4300

        val AT_ONCE = Loops { count, task -> IntStream.range(0, count).parallel().forEach(task) }
    }
}
