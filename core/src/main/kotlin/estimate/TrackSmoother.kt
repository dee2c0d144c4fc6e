package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * One stretch of readings without gaps, for [TrackSmoother].
 *
 * @property times s, growing, length n. @property values readings about their level, sensor units, length n.
 * @property silent readings that show the field from one side only (the sensor is at its limit), length n.
 * @property rising whether the sensor rises, length n. @property looseness how far a silent reading may be beyond the
 * field besides its noise, sensor units, length n. @property ahead how far the field is at the least ahead of a silent
 * reading of a lag that is held at its own limit, sensor units, length n; NaN at all others.
 */
internal class Stretch(
    val times: DoubleArray,
    val values: DoubleArray,
    val silent: BooleanArray,
    val rising: BooleanArray,
    val looseness: DoubleArray,
    val ahead: DoubleArray,
) {
    /** Readings that are left out as outliers, length n. Modified. */
    val outlying = BooleanArray(times.size)

    /**
     * How likely it is, 0..1, that the lags rise on the way to where reading k is seen, at 2k, and to where the field is
     * wanted, at 2k + 1; length 2n. By [rising] until the smoother knows better. Modified.
     */
    val rises = DoubleArray(2 * times.size) { if (rising[it / 2]) 1.0 else 0.0 }

    val size: Int get() = times.size
}

/**
 * The field along a stretch given all its readings: Kalman filter forwards, then Bryson and Frazier's smoother
 * backwards (Bierman 1977, doi:10.1137/0714031), which inverts no matrix.
 *
 * @param stretch the readings. @param response the sensor's. @param along the water's.
 * @param agitation factor on the variance of the field's change over each reading, length n. Retained. @param wander noise
 * of the readings that wanders; null for none.
 */
internal class TrackSmoother(
    private val stretch: Stretch,
    private val response: Response,
    private val along: AlongTrack,
    private val agitation: DoubleArray,
    usual: Double,
    private val wander: SensorStage.Wander? = null,
) {
    private val motion = FieldMotion(along, response.lags, usual, response.slowShare, wander)
    private val size = motion.size

    /** Events in the order of time: reading k seen (2k) a dead time early, field at reading k wanted (2k + 1). */
    private val order: IntArray = order()
    private val x = DoubleArray(size)
    private var p = motion.start()
    private var work = DoubleArray(size * size)

    /** Innovation of each reading and its variance; of a silent one, those of a reading that would say as much. */
    private val innovations: DoubleArray = DoubleArray(stretch.size)
    private val variances: DoubleArray = DoubleArray(stretch.size)
    private val logDensities = DoubleArray(stretch.size)
    private val oneSided = OneSided()

    private val lead = LagLead.of(response, along.states, size)

    /** Squared surprise of each reading, about 1 where the water is as lively as is thought. */
    val surprises: DoubleArray = DoubleArray(stretch.size)

    private fun eventTime(event: Int) = stretch.times[event / 2] - if (event % 2 == 0) response.deadTime else 0.0

    private fun order(): IntArray {
        val merged = IntArray(2 * stretch.size)
        var seen = 0
        var wanted = 0
        for (i in merged.indices) {
            val isSeen = wanted == stretch.size ||
                (seen < stretch.size && stretch.times[seen] - response.deadTime <= stretch.times[wanted])
            merged[i] = if (isSeen) 2 * seen++ else 2 * wanted++ + 1
        }
        return merged
    }

    /** Logarithm of the density of the readings. */
    fun logLikelihood(): Double {
        forward(null)
        return logDensities.sum()
    }

    /** What the backward pass needs of each event. */
    private class Tape(events: Int, size: Int, lead: LagLead?) {
        val moves = arrayOfNulls<DoubleArray>(events)
        val gains = DoubleArray(events * size)
        val seen = IntArray(events)
        val rows = DoubleArray(events * size)
        val means = DoubleArray(events)
        val leads = DoubleArray(if (lead == null) 0 else events)
        val leadRows = DoubleArray(if (lead == null) 0 else events * size)
    }

    private fun forward(tape: Tape?) {
        x.fill(0.0)
        p = motion.start()
        var time = eventTime(order[0])
        for (i in order.indices) {
            val event = order[i]
            val next = eventTime(event)
            if (next > time) {
                val transition = motion.over(next - time, stretch.rises[event])
                predict(transition, agitation[event / 2])
                tape?.moves?.set(i, transition.move)
                time = next
            }
            if (event % 2 == 0) see(event / 2, tape, i) else note(tape, i)
            if (tape != null && lead != null) {
                tape.leads[i] = lead.mean(x)
                lead.covariances(p, tape.leadRows, i * size)
            }
        }
    }

    private fun predict(transition: Transition, factor: Double) {
        val f = transition.move
        val moved = DoubleArray(size)
        for (i in 0 until size) {
            var sum = 0.0
            for (j in 0 until size) sum += f[i * size + j] * x[j]
            moved[i] = sum
            for (j in 0 until size) {
                var s = 0.0
                for (k in 0 until size) s += f[i * size + k] * p[k * size + j]
                work[i * size + j] = s
            }
        }
        moved.copyInto(x)
        for (i in 0 until size) {
            for (j in 0..i) {
                var s = factor * transition.spread[i * size + j]
                for (k in 0 until size) s += work[i * size + k] * f[j * size + k]
                p[i * size + j] = s
                p[j * size + i] = s
            }
        }
    }

    private val shown = motion.shown

    private fun see(reading: Int, tape: Tape?, event: Int) {
        if (stretch.outlying[reading]) return pass(reading)
        val isHeld = !stretch.ahead[reading].isNaN()
        if (isHeld) hold(stretch.values[reading], tape, event)
        // Of a lag that is held back the reading is the state; what it tells is told of the field.
        val seen = if (isHeld) 0 else shown
        val spread = p[seen * size + seen]
        if (stretch.silent[reading]) {
            val isRising = stretch.rising[reading]
            val ahead = if (isHeld) stretch.ahead[reading] else 0.0
            val bound = stretch.values[reading] + if (isRising) ahead else -ahead
            // What is on the right side already is not told again: neighbours say the same thing, and each would be
            // taken for more evidence.
            if (isRising == x[seen] > bound) return pass(reading)
            val looseness = hypot(along.noise, stretch.looseness[reading])
            oneSided.tell(x[seen], spread, bound, isRising, looseness)
            logDensities[reading] = oneSided.logProbability
            val moved = oneSided.mean - x[seen]
            surprises[reading] = (oneSided.variance + moved * moved) / spread
            // A reading of variance v²/(v − v̂) − v would leave the same mean and variance.
            val share = 1 - oneSided.variance / spread
            innovations[reading] = moved / share
            variances[reading] = spread / share
        } else {
            innovations[reading] = stretch.values[reading] - x[shown]
            variances[reading] = spread + along.noise * along.noise
            surprises[reading] = innovations[reading] * innovations[reading] / variances[reading]
            logDensities[reading] = -(ln(2 * PI * variances[reading]) + surprises[reading]) / 2
        }
        val innovation = innovations[reading]
        val variance = variances[reading]
        tape?.seen?.set(event, seen)
        for (i in 0 until size) {
            val gain = p[i * size + seen] / variance
            x[i] += gain * innovation
            work[i] = gain
            tape?.gains?.set(event * size + i, gain)
        }
        for (i in 0 until size) {
            for (j in 0..i) {
                p[i * size + j] -= work[i] * work[j] * variance
                p[j * size + i] = p[i * size + j]
            }
        }
    }

    /** A lag that is held back is at [value], give or take the noise, whatever it was before. */
    private fun hold(value: Double, tape: Tape?, event: Int) {
        val own = along.states until size
        for (i in own) {
            x[i] = value
            for (j in 0 until size) {
                p[i * size + j] = 0.0
                p[j * size + i] = 0.0
            }
        }
        for (i in own) for (j in own) p[i * size + j] = along.noise * along.noise
        if (wander != null) p[along.states * (size + 1)] += wander.standardDeviation * wander.standardDeviation
        if (tape == null) return
        val still = DoubleArray(size * size) { if (it % (size + 1) == 0) 1.0 else 0.0 }
        val move = tape.moves[event]?.copyOf() ?: still
        move.fill(0.0, own.first * size, size * size)
        tape.moves[event] = move
    }

    private fun pass(reading: Int) {
        innovations[reading] = Double.NaN
        variances[reading] = Double.NaN
        logDensities[reading] = 0.0
        surprises[reading] = 1.0
    }

    private fun note(tape: Tape?, event: Int) {
        if (tape == null) return
        tape.means[event] = x[0]
        for (j in 0 until size) tape.rows[event * size + j] = p[j]
    }

    /**
     * Mean and variance of the field at each reading's time and place, into [mean] and [variance]. Modified, as is
     * [Stretch.rises] where the lags rise and fall unlike.
     */
    fun smooth(mean: DoubleArray, variance: DoubleArray) {
        val tape = Tape(order.size, size, lead)
        forward(tape)
        val rising = DoubleArray(tape.leads.size)
        val lambda = DoubleArray(size)
        val big = DoubleArray(size * size)
        val half = DoubleArray(size * size)
        for (i in order.indices.reversed()) {
            val event = order[i]
            if (lead != null) {
                val spread = lead.variance(tape.leadRows, i * size)
                rising[i] = given(tape.leads[i], spread, tape.leadRows, i * size, lambda, big).chanceAbove
            }
            if (event % 2 == 1) {
                val field = given(tape.means[i], tape.rows[i * size], tape.rows, i * size, lambda, big)
                mean[event / 2] = field.mean
                variance[event / 2] = field.variance
            } else if (!innovations[event / 2].isNaN()) {
                forget(tape, i, event / 2, lambda, big)
            }
            tape.moves[i]?.let { back(it, lambda, big, half) }
        }
        if (lead == null) return
        for (i in 1 until rising.size) stretch.rises[order[i]] = (rising[i - 1] + rising[i]) / 2
    }

    private class Smoothed(val mean: Double, val variance: Double) {
        /** Probability of more than 0. */
        val chanceAbove: Double
            get() = TruncatedNormal.cumulative(mean / sqrt(variance).coerceAtLeast(Double.MIN_VALUE))
    }

    /** x − r λ and v − r Λ rᵀ, of what had the mean [x], the variance [v] and the covariances r with all states. */
    private fun given(
        x: Double,
        v: Double,
        rows: DoubleArray,
        from: Int,
        lambda: DoubleArray,
        big: DoubleArray,
    ): Smoothed {
        var m = x
        var left = v
        for (a in 0 until size) {
            m -= rows[from + a] * lambda[a]
            for (b in 0 until size) left -= rows[from + a] * big[a * size + b] * rows[from + b]
        }
        return Smoothed(m, maxOf(left, 0.0))
    }

    /** λ ← Cᵀλ − h v/S, Λ ← CᵀΛC + h hᵀ/S, with C = I − K hᵀ. */
    private fun forget(tape: Tape, event: Int, reading: Int, lambda: DoubleArray, big: DoubleArray) {
        var along = 0.0
        val row = DoubleArray(size)
        for (a in 0 until size) {
            val gain = tape.gains[event * size + a]
            along += gain * lambda[a]
            for (b in 0 until size) row[b] += gain * big[a * size + b]
        }
        var twice = 0.0
        for (b in 0 until size) twice += row[b] * tape.gains[event * size + b]
        val seen = tape.seen[event]
        lambda[seen] -= along + innovations[reading] / variances[reading]
        for (b in 0 until size) {
            big[seen * size + b] -= row[b]
            big[b * size + seen] -= row[b]
        }
        big[seen * size + seen] += twice + 1 / variances[reading]
    }

    /** λ ← Fᵀλ, Λ ← FᵀΛF. */
    private fun back(f: DoubleArray, lambda: DoubleArray, big: DoubleArray, half: DoubleArray) {
        val moved = DoubleArray(size)
        for (i in 0 until size) {
            var s = 0.0
            for (k in 0 until size) s += f[k * size + i] * lambda[k]
            moved[i] = s
            for (j in 0 until size) {
                var t = 0.0
                for (k in 0 until size) t += big[i * size + k] * f[k * size + j]
                half[i * size + j] = t
            }
        }
        moved.copyInto(lambda)
        for (i in 0 until size) {
            for (j in 0 until size) {
                var s = 0.0
                for (k in 0 until size) s += f[k * size + i] * half[k * size + j]
                big[i * size + j] = s
            }
        }
    }
}
