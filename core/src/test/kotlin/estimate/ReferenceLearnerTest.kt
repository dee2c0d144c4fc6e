package stillwater.estimate

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

class ReferenceLearnerTest {
    /** A rate limit of [RATE] reference units per second is found whatever the readings are in. */
    @Test
    fun rateLimitIsInTheUnitsOfTheReference() {
        for (gain in listOf(1.0, 1000.0, -0.02)) {
            val random = Random(3)
            val times = DoubleArray(ROWS) { it.toDouble() }
            val reference = DoubleArray(ROWS) { sin(it / 11.0) + sin(it / 4.7) }
            var shown = reference[0]
            val values = DoubleArray(ROWS) {
                shown = reference[it].coerceIn(shown - RATE, shown + RATE)
                gain * (shown + 0.002 * random.nextDouble()) + 5
            }
            val series = TrackSeries(times, times, DoubleArray(ROWS), values)
            val found = assertNotNull(ReferenceLearner(series, reference).candidate(ResponseKind.SLEW))
            // A fiftieth: the noise is a fiftieth of a second's change.
            assertEquals(RATE, found.parameters[0], RATE / 50, "gain $gain")
        }
    }

    /**
     * A probe that is moved each minute to another sample, unseen: nothing is written for [MISSING] seconds, in which the
     * sample changes at a random moment. What the sensor saw then shows in how it settles.
     */
    private fun moved(kind: ResponseKind, vararg parameters: Double): Pair<TrackSeries, DoubleArray> {
        val random = Random(SEED)
        val sensor = SensorSpec("", kind.response(*parameters).stages()).build(LEVELS[0], random)
        val times = ArrayList<Double>()
        val values = ArrayList<Double>()
        val truths = ArrayList<Double>()
        var moment = 0.0
        for (row in 0 until SECONDS * FINE) {
            val second = row / FINE
            if (row % (MINUTE * FINE) == 0) moment = random.nextDouble() * MISSING
            val within = second % MINUTE + row % FINE / FINE.toDouble()
            val minute = second / MINUTE + if (within < moment) -1 else 0
            val truth = LEVELS[maxOf(minute, 0) % LEVELS.size]
            val shown = sensor.step(truth, 1.0 / FINE, Conditions.NONE)
            if (row % FINE != FINE - 1 || within < MISSING) continue
            times += (row + 1) / FINE.toDouble()
            values += 1.5 * shown + 4 + 0.02 * random.nextDouble(-1.7, 1.7)
            truths += truth
        }
        val still = DoubleArray(times.size)
        return TrackSeries(times.toDoubleArray(), still, still, values.toDoubleArray()) to truths.toDoubleArray()
    }

    @Test
    fun aLagShowsWhereTheSensorSettlesAfterMovesThatWereNotWritten() {
        val (series, truth) = moved(ResponseKind.FIRST_ORDER, 8.0)
        val learner = ReferenceLearner(series, truth)
        val found = assertNotNull(learner.candidate(ResponseKind.FIRST_ORDER))
        assertEquals(8.0, found.parameters[0], 0.1, "seed $SEED")
        val (gain, offset) = learner.calibration(found.response)
        assertEquals(1.5, gain, 0.01, "seed $SEED")
        assertEquals(4.0, offset, 0.03, "seed $SEED")
        val range = learner.lagRange()
        assertTrue(range.start > 6 && range.endInclusive < 11, "$range, seed $SEED")
    }

    /** Little noise tells the lag to a few thousandths, where scores a step of 15 % aside say nothing of how it is told. */
    @Test
    fun intervalsHoldALagThatShowsSharply() {
        val inside = (1..LOGS).count { seed ->
            val random = java.util.Random(1000L + seed)
            val phases = DoubleArray(3) { 6 * random.nextDouble() }
            val truth = DoubleArray(ROWS) {
                sin(it / 11.0 + phases[0]) + sin(it / 4.7 + phases[1]) + 2 * sin(it / 60.0 + phases[2])
            }
            val weights = LagWeights().also { it.set(8.0, 1.0) }
            var state = truth[0]
            val values = DoubleArray(ROWS) {
                if (it > 0) state = weights.keep * state + weights.before * truth[it - 1] + weights.now * truth[it]
                state + 0.02 * random.nextGaussian()
            }
            val times = DoubleArray(ROWS) { it.toDouble() }
            val series = TrackSeries(times, times, DoubleArray(ROWS), values)
            8.0 in assertNotNull(ReferenceLearner(series, truth).candidate(ResponseKind.FIRST_ORDER)).interval(0)
        }
        // Of 95 % of a hundred fewer than 85 are one in ten thousand.
        assertTrue(inside >= 85, "$inside of $LOGS, seeds 1001 to ${1000 + LOGS}")
    }

    @Test
    fun aLagThatIsLongerOneWayShowsToo() {
        val (series, truth) = moved(ResponseKind.ASYMMETRIC, 6.0, 12.0)
        val found = assertNotNull(ReferenceLearner(series, truth).candidate(ResponseKind.ASYMMETRIC))
        assertEquals(6.0, found.parameters[0], 0.15, "seed $SEED")
        assertEquals(12.0, found.parameters[1], 0.3, "seed $SEED")
    }

    /** What a sensor of [kind] shows of twelve waves from two to twenty times [time], s, long; the truth each second. */
    private fun lively(seed: Int, time: Double, kind: ResponseKind, vararg parameters: Double): CandidateResponse? {
        val random = java.util.Random(seed.toLong())
        val waves = List(12) {
            val period = 2 * time * Math.pow(10.0, random.nextDouble())
            Triple(2 * PI / period, 2 * PI * random.nextDouble(), 0.3 + random.nextDouble())
        }
        fun water(t: Double) = waves.sumOf { (pulsation, phase, height) -> height * sin(pulsation * t + phase) }
        val sensor = SensorSpec("", kind.response(*parameters).stages()).build(water(0.0), Random(seed))
        val values = DoubleArray(ROWS) { row ->
            var shown = 0.0
            for (part in 1..FINE) {
                shown = sensor.step(water(row - 1 + (part - 0.5) / FINE), 1.0 / FINE, Conditions.NONE)
            }
            shown + 0.05 * random.nextGaussian()
        }
        val times = DoubleArray(ROWS) { it.toDouble() }
        val series = TrackSeries(times, times, DoubleArray(ROWS), values)
        return ReferenceLearner(series, DoubleArray(ROWS) { water(it.toDouble()) }).candidate(kind)
    }

    /** The likeliest single lag may be five times as long as the sensor's delay, or as long as the log. */
    @Test
    fun aResponseIsFoundWhereTheLikeliestSingleLagIsFarFromIt() {
        for (seed in listOf(1, 2, 14, 28, 42, 47)) {
            for ((kind, parameters) in listOf(
                ResponseKind.DEAD_TIME_AND_LAG to doubleArrayOf(4.2, 8.9),
                ResponseKind.SECOND_ORDER to doubleArrayOf(9.0),
                ResponseKind.TWO_LAGS to doubleArrayOf(4.0, 12.0),
                ResponseKind.TWO_PATH to doubleArrayOf(4.0, 40.0, 0.3),
            )) {
                val found = assertNotNull(lively(seed, parameters.max(), kind, *parameters), "$kind, seed $seed")
                // A tenth: the water between rows is taken for straight, and of two paths something is believed beforehand.
                for (i in parameters.indices) {
                    assertEquals(parameters[i], found.parameters[i], 0.1 * parameters[i], "$kind, $i, seed $seed")
                }
            }
        }
    }

    /** In two groups of rows nothing is ruled out, however far it is behind. */
    @Test
    fun aShortReferenceIsJudgedInGroupsEnoughToRuleOut() {
        val times = DoubleArray(150) { it.toDouble() }
        val truth = DoubleArray(150) { sin(it / 8.0) + sin(it / 3.1) }
        val weights = LagWeights().also { it.set(6.0, 1.0) }
        val random = java.util.Random(7)
        var state = truth[0]
        val values = DoubleArray(150) {
            if (it > 0) state = weights.keep * state + weights.before * truth[it - 1] + weights.now * truth[it]
            state + 0.02 * random.nextGaussian()
        }
        val learner = ReferenceLearner(TrackSeries(times, times, DoubleArray(150), values), truth)
        assertEquals(10, learner.groups)
        val choice = ResponseChoice.of(ResponseKind.entries.mapNotNull(learner::candidate), Random(1))
        assertTrue(choice.open.any { it.kind == ResponseKind.FIRST_ORDER }, "${choice.open.map { it.kind }}, seed 7")
        val impossible = listOf(ResponseKind.NONE, ResponseKind.DEAD_TIME, ResponseKind.SLEW)
        assertTrue(choice.open.none { it.kind in impossible }, "${choice.open.map { it.kind }}, seed 7")
    }

    /** Of a log of one step up, followed by a probe that is not quite of first order: sums of lags as of a thick foil. */
    @Test
    fun noResponseIsTurnedNorLongerThanTheLog() {
        for (seed in 1L..3L) {
            val random = java.util.Random(seed)
            val rows = 60
            val times = DoubleArray(rows) { it.toDouble() }
            val truth = DoubleArray(rows) { if (it < 8) 70.0 else 94.5 - 11 * exp(-(it - 8) / 1.6) }
            val values = DoubleArray(rows) { row ->
                val after = row - 7.6
                val left = (1..9 step 2).sumOf { exp(-after * it * it / 30.0) / (it * it) } / 1.18
                70 + (if (after < 0) 0.0 else 24.5 * (1 - left)) + 0.02 * random.nextGaussian()
            }
            val learner = ReferenceLearner(TrackSeries(times, times, DoubleArray(rows), values), truth)
            assertEquals(null, learner.candidate(ResponseKind.ASYMMETRIC), "how it falls does not show, seed $seed")
            for (kind in ResponseKind.entries) {
                val found = learner.candidate(kind) ?: continue
                assertTrue(learner.calibration(found.response).first > 0, "$kind, seed $seed")
                val longest = found.response.lags.maxOfOrNull { it.rising } ?: 0.0
                // What keeps a search off lags beyond the log is a slope, and no wall.
                assertTrue(longest < 1.1 * rows, "$kind $longest s, seed $seed")
            }
        }
    }

    private companion object {
        const val ROWS = 600
        const val SEED = 20261127
        const val LOGS = 100
        const val SECONDS = 1200
        const val MINUTE = 60
        const val FINE = 20
        const val MISSING = 8
        val LEVELS = doubleArrayOf(2.0, 8.0, 5.0, 11.0, 3.0, 9.0)
        const val RATE = 0.1
    }
}
