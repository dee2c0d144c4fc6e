package stillwater.estimate

import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * At which readings the sensor rises, and at which it runs at its rate limit.
 *
 * @property rising length n. @property silent length n; never without a limit.
 * @property looseness how far a silent reading may be beyond the bound that it sets, sensor units, length n: where a limit
 * stands behind the lags as far as the sensor may have gone between it and the run that it touches, 0 in a run.
 * @property ahead how far the field is ahead of a silent reading of a single lag that is held at its own limit, at the least,
 * sensor units, at least 0, length n; NaN at all others.
 */
internal class SensorSides(series: TrackSeries, response: Response, resolution: Double) {
    val rising: BooleanArray
    val silent: BooleanArray
    val looseness: DoubleArray
    val ahead: DoubleArray

    init {
        val isLimited = response.slewRate.isFinite()
        val noise = if (isLimited) roughness(series) else 0.0
        val scatter = noise + resolution / 2
        val reach = if (isLimited) reach(series, response.slewRate, scatter) else FEWEST + 1
        val slopes = slopes(series, reach)
        rising = BooleanArray(series.size) { slopes[it] > 0 }
        val running = BooleanArray(series.size) { abs(slopes[it]) > AT_LIMIT * response.slewRate }
        silent = running.copyOf()
        // A slope reaches over its neighbours: what touches a run may be at the limit, too.
        if (isLimited) {
            for (step in listOf(1, -1)) touching(series, response.slewRate, running, reach, BEHIND * scatter, step)
        }
        val held = response.lags.singleOrNull()?.takeIf { response.isLimitWithin && isLimited }
        if (held == null) {
            if (response.isLimitWithin) {
                linger(series.times, running, LINGERS * (response.meanDelay - response.deadTime))
            }
            val touched = if (isLimited) reach * series.medianStep * response.slewRate else 0.0
            looseness = DoubleArray(series.size) { if (running[it]) 0.0 else touched }
            ahead = DoubleArray(series.size) { Double.NaN }
        } else {
            // τ ds/dt = ψ − s, and ψ is farther than that where ds/dt is at its limit.
            val lags = DoubleArray(series.size) { if (rising[it]) held.rising else held.falling }
            val error = noise / (sqrt(2.0) * reach * series.medianStep)
            ahead = DoubleArray(series.size) {
                if (silent[it]) lags[it] * minOf(abs(slopes[it]), response.slewRate) else Double.NaN
            }
            looseness = DoubleArray(series.size) {
                if (silent[it]) lags[it] * maxOf(response.slewRate - abs(slopes[it]), error) else 0.0
            }
        }
    }

    /**
     * The first of two lags that was held back itself shows after a run what one without a limit would have shown before,
     * which is beyond it on the run's side until that has faded: for [seconds] after each run of rows that are [running].
     */
    private fun linger(times: DoubleArray, running: BooleanArray, seconds: Double) {
        var last = -1
        for (i in running.indices) {
            if (running[i]) {
                last = i
            } else if (last >= 0 && times[i] - times[last] < seconds) {
                silent[i] = true
                rising[i] = rising[last]
            }
        }
    }

    /**
     * Marks the rows next to each run, up to [reach] of them, as long as readings are on the line of slope [rate] through
     * the run's end: a sensor that has left its limit falls behind that.
     *
     * @param scatter how far behind it the noise of readings brings them, sensor units. @param step 1 for rows after runs, −1
     * for rows before.
     */
    private fun touching(
        series: TrackSeries,
        rate: Double,
        running: BooleanArray,
        reach: Int,
        scatter: Double,
        step: Int,
    ) {
        for (end in running.indices) {
            val isEnd = running[end] && running.getOrNull(end + step) == false
            if (!isEnd) continue
            val slope = if (rising[end]) rate else -rate
            val within = (0..reach).map { end - step * it }.takeWhile { it in running.indices && running[it] }

            fun beyond(row: Int) = series.values[row] - slope * (series.times[row] - series.times[end])
            val level = within.sumOf(::beyond) / within.size
            val side = if (rising[end]) step else -step

            fun isOff(row: Int) = (level - beyond(row)) * side > scatter
            for (k in 1..reach) {
                val row = end + step * k
                if (row !in running.indices || running[row]) break
                // One alone may be noise.
                if (isOff(row) && (row + step !in running.indices || isOff(row + step))) break
                silent[row] = true
            }
        }
    }

    companion object {
        /** Time constants after which nothing is left of what a limit held back. */
        private const val LINGERS = 4.0

        /** A reading so many deviations of its noise behind what a sensor at its limit shows is off it. */
        private const val BEHIND = 2.5
        private const val AT_LIMIT = 0.85
        private const val FEWEST = 2
        private const val MOST = 8
        private const val NOISE_SHARE = 0.1
        private const val TOP = 0.995
        private const val AT = 0.8
        private const val BELOW = 0.4
        private const val FEWEST_SHARE = 0.08
        private const val TIMES_BELOW = 0.45
        private const val FEWER_SHARE = 0.2
        private const val FEWEST_ROWS = 200
        private const val FEWEST_RUNS = 6
        private const val CLEAR = 0.02
        private const val NARROW = 0.043
        private const val MOST_PART = 0.9

        /** Times behind the water are the same if most lie within such a part of their median; a limit's do not. */
        private const val SAME_TIME = 0.3

        /** So wide is that range of half the difference of two readings in a normal distribution, in their noise. */
        private const val NOISE_WIDTH = 1.8

        /** The slower the limit, the longer a line has to be to stand out of the noise, and the longer are the runs. */
        private val REACHES = listOf(1, 2, 3, 4, 6, 8, 10, 12, 16, 24, 36)

        /** Slopes over so many rows either way that noise hardly bears on them. */
        private fun reach(series: TrackSeries, rate: Double, scatter: Double): Int =
            (scatter / (NOISE_SHARE * rate * series.medianStep)).toInt().coerceIn(1, MOST)

        /** Standard deviation of what changes from one reading to the next but one, by its median. */
        private fun roughness(series: TrackSeries): Double {
            if (series.size < 3) return 0.0
            val seconds = DoubleArray(series.size - 2) {
                abs(series.values[it] - 2 * series.values[it + 1] + series.values[it + 2])
            }.apply { sort() }
            return seconds[seconds.size / 2] / (0.6745 * sqrt(6.0))
        }

        private fun slopes(series: TrackSeries, reach: Int) = DoubleArray(series.size) { i ->
            val from = maxOf(0, i - reach)
            val to = minOf(series.size - 1, i + reach)
            if (to == from) 0.0 else (series.values[to] - series.values[from]) / (series.times[to] - series.times[from])
        }

        /** See [rateLimit] of a series. */
        fun rateLimit(series: TrackSeries): Double {
            if (series.size < FEWEST_ROWS) return Double.NaN
            for (reach in REACHES) {
                if (series.size < 4 * reach) break
                val slopes = lineSlopes(series, reach)
                if (slopes.isEmpty()) continue
                val sizes = slopes.map { abs(it) }.sorted()
                val top = sizes[(sizes.size * TOP).toInt().coerceAtMost(sizes.size - 1)]
                val rows = 2.0 * reach + 1
                val noise = noise(series) * sqrt(12 / (rows * (rows * rows - 1))) / series.medianStep
                if (noise >= CLEAR * top) continue
                val rate = plateau(slopes, sizes, top)
                if (rate.isNaN()) continue
                val isLimit = runs(slopes, rate) >= FEWEST_RUNS && !isWater(series, rate, reach)
                return if (isLimit) rate else Double.NaN
            }
            return Double.NaN
        }

        /** How often [slopes], in the order of time, come to [rate] from below: few swings of smooth water do, too. */
        private fun runs(slopes: List<Double>, rate: Double): Int {
            fun isAt(slope: Double) = abs(slope) >= AT * rate
            return slopes.indices.count { isAt(slopes[it]) && (it == 0 || !isAt(slopes[it - 1])) }
        }

        /**
         * Whether the water itself has the slope [rate]: a sensor at its limit is behind the water, the longer the
         * further it has come, so that a pass on which it rises and one on which it falls differ where they meet, here
         * by less and there by more. They agree up to a row, which a boat's fixes and its clock may be off, or are
         * behind by the same time everywhere as a lag, a dead time or such a clock is.
         *
         * @param reach rows either way over which [rate] was found: over fewer the noise may have steeper slopes.
         */
        private fun isWater(series: TrackSeries, rate: Double, reach: Int): Boolean {
            val found = TrackCrossings(series.withFreshPositions())
            val slopes = slopes(series, reach)
            val behind = (0 until found.size).mapNotNull { k ->
                val one = slopes[found.one(k)]
                val other = slopes[found.other(k)]
                val isOpposed = one * other < 0 && minOf(abs(one), abs(other)) >= AT_LIMIT * rate
                if (!isOpposed) return@mapNotNull null
                val difference = valueAt(series, found.other(k), found.shareOther(k)) -
                    valueAt(series, found.one(k), found.shareOne(k))
                difference * (if (one > 0) 1 else -1) / (2 * rate)
            }.sorted()
            if (behind.size < TrackAgreement.FEWEST) return false
            fun quantile(share: Double) = behind[(share * (behind.size - 1)).toInt()]
            val median = quantile(0.5)
            val scatter = NOISE_WIDTH * roughness(series) / rate
            val width = quantile(MOST_PART) - quantile(1 - MOST_PART)
            return median <= series.medianStep || width < hypot(SAME_TIME * median, scatter)
        }

        private fun valueAt(series: TrackSeries, row: Int, share: Double) =
            (1 - share) * series.values[row] + share * series.values[row + 1]

        /** Of a reading, with what rounding does to it: in rounded readings that hardly change nothing else shows. */
        private fun noise(series: TrackSeries): Double {
            val steps = (1 until series.size).map { abs(series.values[it] - series.values[it - 1]) }.filter { it > 0 }
            return maxOf(roughness(series), (steps.minOrNull() ?: 0.0) / sqrt(12.0))
        }

        /** Slopes of the straight lines through so many readings either way: noise bears less on them than on ends. */
        private fun lineSlopes(series: TrackSeries, reach: Int): List<Double> =
            (reach until series.size - reach).filter {
                series.times[it + reach] - series.times[it - reach] <= 3 * reach * series.medianStep
            }.map { i ->
                val rows = i - reach..i + reach
                val time = rows.sumOf { series.times[it] } / rows.count()
                val value = rows.sumOf { series.values[it] } / rows.count()
                rows.sumOf { (series.times[it] - time) * (series.values[it] - value) } /
                    rows.sumOf { (series.times[it] - time) * (series.times[it] - time) }
            }

        /** Where [slopes], of which [sizes] are the absolute values, pile up below [top]; NaN if they thin out. */
        private fun plateau(slopes: List<Double>, sizes: List<Double>, top: Double): Double {
            val at = sizes.filter { it >= AT * top }
            val below = sizes.count { it >= BELOW * top && it < AT * top }
            // A trend runs one way only.
            val fewer = minOf(slopes.count { it >= AT * top }, slopes.count { it <= -AT * top })
            val isPlateau = at.size >= FEWEST_SHARE * sizes.size && at.size >= TIMES_BELOW * below &&
                fewer >= FEWER_SHARE * at.size
            if (!isPlateau) return Double.NaN
            // The narrowest range that holds half of them: noise and the ends of runs lie beside it. A sine's slopes
            // pile up below their largest, too, but half of them take a twentieth of it.
            val half = (at.size + 1) / 2
            val from = (0..at.size - half).minBy { at[it + half - 1] - at[it] }
            val rate = at[from + half / 2]
            return if (at[from + half - 1] - at[from] < NARROW * rate) rate else Double.NaN
        }
    }
}

/**
 * The rate at which the sensor of these readings often runs and which it hardly ever exceeds, sensor units/s; NaN where
 * there is none. No lag does that and hardly any water, whose slopes thin out towards their largest: to and fro over an
 * even slope they do not, but then passes up and down agree, or a lag or a dead time sets them apart by the same time
 * everywhere.
 */
public fun TrackSeries.rateLimit(): Double = SensorSides.rateLimit(this)
