package stillwater.estimate

import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class TrackCorrectionTest {
    private val lag = listOf(SensorStage.Lag(10.0))

    private fun choice(log: LawnmowerLog): ResponseChoice {
        val learner = RevisitLearner.of(log.series)
        val kinds = ResponseKind.entries - ResponseKind.SLEW
        return ResponseChoice.of(kinds.mapNotNull(learner::candidate), Random(1))
    }

    private fun covered(log: LawnmowerLog, track: CorrectedTrack): Double {
        val inside = log.truth.indices.count { log.truth[it] in track.lower[it]..track.upper[it] }
        return inside.toDouble() / log.truth.size
    }

    @Test
    fun correctedPhaseOfASineIsThatOfTheTruth() {
        val omega = 0.1
        val response = Response(3.0, listOf(ResponseLag(8.0), ResponseLag(5.0)))
        val phase = omega * 3 + kotlin.math.atan(omega * 8) + kotlin.math.atan(omega * 5)
        assertUndone(response, omega, phase, size = 2000, middle = 500 until 1500)
    }

    private fun assertUndone(response: Response, omega: Double, phase: Double, size: Int, middle: IntRange) {
        val times = DoubleArray(size) { it.toDouble() }
        val series = TrackSeries(times, times, DoubleArray(size), DoubleArray(size) { sin(omega * it - phase) })
        val corrected = DoubleArray(size).also { PhaseCorrection(series).correct(response, it) }
        // A twentieth of the amplitude: what the ends of the series leave in its middle.
        for (i in middle) assertEquals(sin(omega * i), corrected[i], 0.05)
    }

    @Test
    fun transformThereAndBackGivesTheSame() {
        val fourier = Fourier(64)
        val re = DoubleArray(64) { cos(0.7 * it) + it % 5 }
        val im = DoubleArray(64)
        val before = re.copyOf()
        fourier.transform(re, im, backwards = false)
        assertEquals(before.sum(), re[0], 1e-9)
        fourier.transform(re, im, backwards = true)
        for (i in re.indices) assertEquals(before[i], re[i] / 64, 1e-12)
    }

    @Test
    fun repeatedFixesAreSpreadOverTheWayToTheNextOne() {
        val series = TrackSeries(
            DoubleArray(5) { it.toDouble() },
            doubleArrayOf(0.0, 0.0, 0.0, 3.0, 4.0),
            DoubleArray(5),
            DoubleArray(5),
        )
        assertEquals(listOf(0.0, 1.0, 2.0, 3.0, 4.0), series.withFreshPositions().xs.toList())
    }

    @Test
    fun timeConstantIsFoundWithoutAnyHint() {
        val found = choice(LawnmowerLog(seed = 11, lag, legs = 8))
        val standing = found.standings.first { it.candidate.kind == ResponseKind.FIRST_ORDER }
        assertTrue(standing.isOpen, "the true response must stay open")
        // Four of its own standard errors, and no more than a quarter.
        val error = 4 * standing.candidate.relativeErrors[0] * standing.candidate.parameters[0]
        assertEquals(10.0, standing.candidate.parameters[0], minOf(2.5, maxOf(error, 1.0)))
        assertFalse(found.open.any { it.kind == ResponseKind.NONE }, "a lag of 10 s is not none")
        assertFalse(found.open.any { it.kind == ResponseKind.ASYMMETRIC }, "the sensor is symmetric")
    }

    /** Two readings a node: shifts of nodes to one side only would make all delays short by half a reading. */
    @Test
    fun deadTimeIsFoundToAFractionOfAReading() {
        val found = (51..53).map { seed ->
            val log = LawnmowerLog(seed, listOf(SensorStage.Delay(4.0)))
            checkNotNull(RevisitLearner.of(log.series).candidate(ResponseKind.DEAD_TIME)).parameters[0]
        }
        // Three standard errors of the mean, of 0.15 s each log.
        assertEquals(4.0, found.average(), 0.26, "$found")
    }

    /** [log] as a sensor shows it that is [late] seconds behind, by the time. */
    private fun delayed(log: LawnmowerLog, late: (Double) -> Double): TrackSeries {
        val of = log.series
        return TrackSeries(
            of.times,
            of.xs,
            of.ys,
            DoubleArray(of.size) {
                of.values[maxOf(0, (it - late(it.toDouble())).toInt())]
            },
        )
    }

    @Test
    @Tag("long")
    fun delaysThatDifferAlongTheTrackAreTold() {
        val log = LawnmowerLog(seed = 61, emptyList())
        fun unevenness(late: (Double) -> Double): Double {
            val learner = RevisitLearner.of(delayed(log, late))
            return learner.unevenness(checkNotNull(learner.candidate(ResponseKind.DEAD_TIME)).response)
        }
        val same = unevenness { 6.0 }
        assertTrue(same < 1.5, "$same")
        // Between 2 and 10 s: a standard deviation of 2.8 s.
        val changing = unevenness { 6 + 4 * sin(it / 60) }
        assertTrue(changing in 2.0..5.0, "$changing")
    }

    /** Fixes off by up to 0.7 m along the way make times at 1 m/s wrong by 0.7 s: less than a row, or three of five a second. */
    @Test
    @Tag("long")
    fun fixesAreNoMoreOffWhereTheSensorIsReadMoreOften() {
        val random = Random(5)
        val waves = List(40) { List(3) { random.nextDouble(-1.0, 1.0) } }
        val times = DoubleArray(5 * 8 * 126) { it / 5.0 }
        val xs = DoubleArray(times.size) { 6 * (times[it] / 126).toInt() + maxOf(0.0, times[it] % 126 - 120) }
        val ys = DoubleArray(times.size) {
            val up = minOf(times[it] % 126, 120.0)
            if ((times[it] / 126).toInt() % 2 == 0) up else 120 - up
        }
        val values = DoubleArray(times.size) { row ->
            waves.sumOf { (a, b, c) -> 0.2 * sin((a * xs[row] + b * ys[row]) / 8 + 3 * c) } + 0.02 * random.nextDouble()
        }
        val fixes = DoubleArray(times.size) { ys[it] + 0.7 * sin(times[it] / 40) }
        val learner = RevisitLearner.of(TrackSeries(times, xs, fixes, values))
        assertTrue(learner.blocks > 0)
        assertEquals(0.0, learner.unevenness(Response()))
    }

    @Test
    fun noLagIsNotRuledOutWhereThereIsNone() {
        val found = choice(LawnmowerLog(seed = 12, emptyList(), legs = 8))
        assertTrue(found.open.any { it.kind == ResponseKind.NONE })
    }

    @Test
    fun intervalsCoverTheWaterWhereTheSensorIsGiven() {
        val sensors = listOf(
            lag to Response(lags = listOf(ResponseLag(10.0))),
            listOf(SensorStage.Delay(8.0)) to Response(8.0),
            listOf(SensorStage.Lag(6.0), SensorStage.Lag(6.0)) to Response(lags = List(2) { ResponseLag(6.0) }),
            listOf(SensorStage.Asymmetric(13.0, 7.0)) to Response(lags = listOf(ResponseLag(13.0, 7.0))),
            listOf(SensorStage.LimitedLag(8.0, 0.03)) to
                Response(lags = listOf(ResponseLag(8.0)), slewRate = 0.03, isLimitWithin = true),
            listOf(SensorStage.Lag(8.0), SensorStage.Slew(0.03)) to
                Response(lags = listOf(ResponseLag(8.0)), slewRate = 0.03),
        )
        for ((stages, response) in sensors) {
            val log = LawnmowerLog(seed = 14, stages)
            val track = TrackCorrector(log.series, 0.01).correct(listOf(LikelyResponse(listOf(response), 1.0)))
            // 95 % of 2700 rows that are alike over some ten rows: two standard errors of 270 rows are 2.7 %.
            assertEquals(0.95, covered(log, track), 0.04, "$response")
        }
    }

    /** After each turn of the water the sensor runs the other way while a lag without a limit would still be beyond it. */
    @Test
    fun aLagHeldBackItselfIsUndoneWhereItTurns() {
        val random = Random(15)
        val stage = SensorStage.LimitedLag(8.0, 0.03)
        val n = 2400
        val times = DoubleArray(n) { it.toDouble() }
        fun water(time: Double) = abs(time % 120 - 60) * 0.05 + 0.4 * sin(time / 53)
        val truth = DoubleArray(n) { water(times[it]) }
        val sensor = stage.build(truth[0], kotlin.random.Random(1))
        val values = DoubleArray(n) { row ->
            var shown = 0.0
            for (part in 1..10) shown = sensor.step(water(row - 1 + (part - 0.5) / 10), 0.1, Conditions.NONE)
            shown + 0.01 * (random.nextDouble() - 0.5)
        }
        val series = TrackSeries(times, DoubleArray(n) { 0.5 * it }, DoubleArray(n), values)
        val response = UndoableSensor.of(SensorSpec("given", listOf(stage))).response
        val track = TrackCorrector(series, 0.0).correct(listOf(LikelyResponse(listOf(response), 1.0)))
        val held = (0 until n).count { truth[it] in track.lower[it]..track.upper[it] }
        // Twenty turns, each one piece of evidence: two standard errors are 10 %.
        assertEquals(0.95, held / n.toDouble(), 0.1)
    }

    @Test
    fun rateLimitIsFoundUnderNoiseAndItsIntervalsHoldTheWaterThatOutranIt() {
        for ((seed, rate) in listOf(31 to 0.04, 32 to 0.02)) {
            val log = LawnmowerLog(seed, listOf(SensorStage.Slew(rate)), noise = 0.02)
            val found = log.series.rateLimit()
            assertEquals(rate, found, 0.05 * rate)
            val track = TrackCorrector(log.series, 0.01).correct(
                listOf(LikelyResponse(listOf(Response(slewRate = found)), 1.0)),
            )
            // Runs of some 20 s are one piece of evidence each, some 100 of them: two standard errors are 5 %.
            assertEquals(0.93, covered(log, track), 0.06, "$rate")
            val (silent, heard) = log.truth.indices.partition { track.silent[it] }
            fun halfWidth(rows: List<Int>) = rows.sumOf { track.upper[it] - track.lower[it] } / 2 / rows.size
            assertTrue(halfWidth(silent) > 5 * halfWidth(heard), "a bound is no reading")
        }
    }

    @Test
    fun anEvenSlopeOfTheWaterIsNoRateLimit() {
        val random = Random(5)
        val times = DoubleArray(1500) { it.toDouble() }
        val xs = DoubleArray(1500) { abs(it % 240 - 120) + 0.2 * random.nextDouble() }
        val ys = DoubleArray(1500) { 0.2 * random.nextDouble() }
        val evenWater = DoubleArray(1500) { 0.01 * abs(it % 240 - 120) + 0.003 * random.nextDouble() }
        assertTrue(TrackSeries(times, xs, ys, evenWater).rateLimit().isNaN())
        // The same readings where no pass meets another leave the question open.
        val apart = DoubleArray(1500) { 2.0 * it }
        assertEquals(0.01, TrackSeries(times, apart, ys, evenWater).rateLimit(), 0.0005)
        // One swing of a wave piles up its slopes as runs do.
        val swing = DoubleArray(400) { Math.rint(1000 * sin(it / 60.0)) / 1000 }
        val early = times.copyOf(400)
        assertTrue(TrackSeries(early, early, early, swing).rateLimit().isNaN())
    }

    /** Such sensors are behind the water by the same time wherever they are, one at its rate limit is not. */
    @Test
    fun anEvenSlopeSeenThroughASlowSensorIsNoRateLimit() {
        val sensors = listOf(3.0, 8.0, 15.0).map { SensorStage.Lag(it) } + SensorStage.Delay(6.0)
        val times = DoubleArray(1500) { it.toDouble() }
        val xs = DoubleArray(1500) { abs(it % 240 - 120).toDouble() }
        for ((stage, reach) in sensors.flatMap { listOf(it to 0.003, it to 0.03) }) {
            val random = Random(7)
            val sensor = SensorSpec("slow", listOf(stage)).build(0.01 * xs[0], random)
            val values = DoubleArray(1500) {
                sensor.step(0.01 * xs[it], 1.0, Conditions.NONE) + reach * random.nextDouble()
            }
            val rate = TrackSeries(times, xs, DoubleArray(1500), values).rateLimit()
            assertTrue(rate.isNaN(), "$stage, noise of $reach: $rate")
        }
    }

    @Test
    fun slowRateLimitIsFoundByLongLines() {
        val found = (36..41).map { seed ->
            LawnmowerLog(seed, listOf(SensorStage.Slew(0.01)), noise = 0.02).series.rateLimit()
        }.filter { it.isFinite() }
        // Where hardly a run ends by itself the rate does not stand out; what is found must be right.
        assertTrue(found.size >= 3, "$found of six")
        for (rate in found) assertEquals(0.01, rate, 0.0005)
        for (seed in 42..44) {
            val slow = listOf(SensorStage.Lag(60.0))
            assertTrue(LawnmowerLog(seed, slow, noise = 0.02).series.rateLimit().isNaN(), "seed $seed")
        }
    }

    @Test
    fun noLagNoTrendAndNoWaveIsTakenForARateLimit() {
        for ((seed, stages) in listOf(33 to lag, 34 to emptyList(), 35 to listOf(SensorStage.Delay(8.0)))) {
            assertTrue(LawnmowerLog(seed, stages, noise = 0.02).series.rateLimit().isNaN(), "$stages")
        }
        val times = DoubleArray(500) { it.toDouble() }
        assertTrue(TrackSeries(times, times, times, DoubleArray(500) { 0.1 * it }).rateLimit().isNaN())
        for (length in listOf(9.0, 30.0)) {
            val wave = DoubleArray(500) { Math.rint(100 * sin(it / length)) / 100 }
            assertTrue(TrackSeries(times, times, times, wave).rateLimit().isNaN(), "$length")
        }
    }

    @Test
    fun whatIsToldToLieAboveABoundIsCutThere() {
        val told = OneSided()
        // Half of a standard normal distribution: mean sqrt(2/π), variance 1 − 2/π.
        told.tell(0.0, 1.0, 0.0, isAbove = true, looseness = 1e-6)
        assertEquals(0.797885, told.mean, 1e-5)
        assertEquals(0.363380, told.variance, 1e-5)
        assertEquals(-0.693147, told.logProbability, 1e-5)
        told.tell(0.0, 1.0, -50.0, isAbove = false, looseness = 1e-6)
        assertEquals(-50.02, told.mean, 0.001)
        assertTrue(told.variance > 0 && told.logProbability < -1000)
    }

    @Test
    fun aWildReadingIsLeftOutAndAFrontIsNot() {
        val log = LawnmowerLog(seed = 17, lag, legs = 4)
        val series = log.series
        val row = series.size / 2
        val spiked = series.values.copyOf().also { it[row] += 3.0 }
        val given = listOf(LikelyResponse(listOf(Response(lags = listOf(ResponseLag(10.0)))), 1.0))
        val track = TrackCorrector(TrackSeries(series.times, series.xs, series.ys, spiked), 0.01).correct(given)
        assertEquals(listOf(row), track.outlying.indices.filter { track.outlying[it] })
        // The lag undone would make 30 of 3; a tenth is what the water moves by between readings.
        assertEquals(log.truth[row], track.values[row], 0.2)
        assertTrue(spiked[row] <= track.upper[row] && log.truth[row] >= track.lower[row])
        // A front of 3, as a lag of 10 s shows it.
        val stepped = DoubleArray(series.size) {
            series.values[it] + if (it >= row) 3 * (1 - kotlin.math.exp((row - it) / 10.0)) else 0.0
        }
        val front = TrackCorrector(TrackSeries(series.times, series.xs, series.ys, stepped), 0.01).correct(given)
        assertFalse(front.outlying.any { it })
    }

    @Test
    fun constantReadingsStayAsTheyAre() {
        val times = DoubleArray(200) { it.toDouble() }
        val series = TrackSeries(times, times, DoubleArray(200), DoubleArray(200) { 7.0 })
        val track = TrackCorrector(series).correct(listOf(LikelyResponse(listOf(Response(5.0)), 1.0)))
        for (i in 0 until 200) {
            // The level is known to rounding; the interval holds it.
            assertEquals(7.0, track.values[i], 1e-6)
            assertTrue(7.0 in track.lower[i]..track.upper[i])
        }
    }

    @Test
    fun trackThatNeverComesBackSaysNothing() {
        val times = DoubleArray(500) { it.toDouble() }
        val learner = RevisitLearner.of(
            TrackSeries(
                times,
                times,
                DoubleArray(500),
                DoubleArray(500) {
                    sin(it / 30.0)
                },
            ),
        )
        assertEquals(0, learner.blocks)
        assertEquals(null, learner.candidate(ResponseKind.FIRST_ORDER))
    }

    @Test
    fun referenceGivesTimeConstantGainAndOffset() {
        val log = LawnmowerLog(seed = 15, lag)
        val series = log.series
        val scaled = TrackSeries(
            series.times,
            series.xs,
            series.ys,
            DoubleArray(series.size) {
                2 * series.values[it] -
                    30
            },
        )
        val learner = ReferenceLearner(scaled, log.truth)
        val candidate = requireNotNull(learner.candidate(ResponseKind.FIRST_ORDER))
        // A twentieth: the reference is known each second only.
        assertEquals(10.0, candidate.parameters[0], 0.5)
        val (gain, offset) = learner.calibration(candidate.response)
        assertEquals(2.0, gain, 0.02)
        assertEquals(-30.0, offset, 2.0)
    }

    @Test
    fun aSlowPathBesideAFastOneIsLearnedWithItsShare() {
        val log = LawnmowerLog(seed = 16, listOf(SensorStage.TwoPath(5.0, 60.0, 0.3)), legs = 8)
        val reference = ReferenceLearner(log.series, log.truth)
        val found = ResponseChoice.of(ResponseKind.entries.mapNotNull(reference::candidate), Random(1))
        assertEquals(ResponseKind.TWO_PATH, found.first.kind)
        // A tenth: the reference is known each second only, the slow path is a belief's factor away from its usual.
        val (fast, slow, share) = found.first.parameters
        assertEquals(5.0, fast, 0.5)
        assertEquals(60.0, slow, 6.0)
        assertEquals(0.3, share, 0.03)
    }

    @Test
    fun phaseOfTwoPathsIsThatOfTheirSum() {
        val omega = 0.05
        val response = Response(2.0, listOf(ResponseLag(8.0), ResponseLag(70.0)), slowShare = 0.2)
        val re = 0.8 / (1 + 0.4 * 0.4) + 0.2 / (1 + 3.5 * 3.5)
        val im = 0.8 * 0.4 / (1 + 0.4 * 0.4) + 0.2 * 3.5 / (1 + 3.5 * 3.5)
        val phase = omega * 2 + kotlin.math.atan2(im, re)
        assertUndone(response, omega, phase, size = 4000, middle = 1500 until 2500)
    }

    @Test
    fun directionsOfACovarianceAreItsOwn() {
        val matrix = arrayOf(doubleArrayOf(4.0, 1.0, 0.5), doubleArrayOf(1.0, 3.0, -0.2), doubleArrayOf(0.5, -0.2, 1.0))
        val eigen = SymmetricEigen(matrix)
        for (i in 0..2) {
            for (j in 0..2) {
                val again = (0..2).sumOf { eigen.values[it] * eigen.vectors[it][i] * eigen.vectors[it][j] }
                assertEquals(matrix[i][j], again, 1e-12)
            }
        }
        assertTrue(eigen.values.toList() == eigen.values.sortedDescending())
    }

    @Test
    fun badSeriesAreRefusedWithTheRule() {
        val two = doubleArrayOf(0.0, 1.0)
        assertFailsWith<IllegalArgumentException> { TrackSeries(doubleArrayOf(1.0, 1.0), two, two, two) }
        assertFailsWith<IllegalArgumentException> { TrackSeries(two, two, two, doubleArrayOf(1.0, Double.NaN)) }
        assertFailsWith<IllegalArgumentException> { TrackSeries(two, two, two, doubleArrayOf(1.0)) }
        assertFailsWith<IllegalArgumentException> { Response(-1.0) }
        assertFailsWith<IllegalArgumentException> { ResponseLag(0.0) }
        assertTrue(abs(Response(2.0, listOf(ResponseLag(4.0))).meanDelay - 6) < 1e-12)
    }
}
