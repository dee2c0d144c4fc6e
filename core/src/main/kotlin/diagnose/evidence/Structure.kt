package stillwater.diagnose.evidence

import stillwater.diagnose.Dependence
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.isFlat
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.model.Conditions
import java.util.Locale
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.expm1
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Looks for any dependence of residuals that no cause of the list need explain.
 *
 * @param isPart whether only the rows that [fit] uses say what is ordinary.
 */
internal class Structure(private val fit: ModelFit, private val isPart: Boolean = false) {
    private val series = fit.model.series
    private val scales = fit.model.scales
    private val n = series.size
    private val basis by lazy { Evidence.orthonormal(fit.jacobian.toList() + StepShifts(fit).columns) }
    private val square = squares(fit.whitened)
    private val prediction = fit.predicted
    private val rate = DoubleArray(n) { series.rise(prediction, it, it) }

    /** All looks, each by itself. */
    private fun looks() = groups().map { (name, columns) -> test(name, columns) } + periodic() + settling()

    private fun test(name: String, columns: List<DoubleArray>): Dependence {
        val whitened = columns.map { column -> DoubleArray(n).also { fit.noise.whiten(column, it) } }
        val directions = Evidence.orthonormal(whitened, basis)
        if (directions.isEmpty()) return Dependence(name, 0.0, 1, 1.0)
        val explained = directions.sumOf { direction -> dot(direction, fit.whitened).let { it * it } }
        // Of what the columns leave: what they explain would count as correlation of its own score.
        val rest = Evidence.without(fit.whitened, directions)
        val inflation = Evidence.inflation(directions, rest, isGivenBack = true)
        val quick = Evidence.ratio(square, square - explained, fit.noise.rows)
        val ratio = minOf(quick, evenly(rest)) / inflation
        return Dependence(name, ratio, directions.size, Evidence.pValue(ratio, directions.size))
    }

    /** The gain of what leaves [rest], where each row counts as much as is left scatters there. */
    private fun evenly(rest: DoubleArray): Double {
        val factors = LocalSpread.of(fit, rest)
        var before = 0.0
        var after = 0.0
        for (i in 0 until n) {
            val weight = 1 / (factors[i] * factors[i])
            before += weight * fit.whitened[i] * fit.whitened[i]
            after += weight * rest[i] * rest[i]
        }
        return Evidence.ratio(before, after, fit.noise.rows)
    }

    private fun groups(): List<Pair<String, List<DoubleArray>>> = buildList {
        val value = standard(prediction)
        val slope = standard(rate)
        add("the value itself (a curved calibration)" to listOf(power(value, 2), power(value, 3), power(value, 4)))
        add(
            "the rate of change (not in proportion)" to
                listOf(absolute(slope), times(slope, absolute(slope)), power(slope, 2)),
        )
        add(SLOW to slow(series))
        add("what was there before (the response has another shape)" to response())
        add("the rate of change, more at some values than at others" to moved(slope, value))
        val age = standard(DoubleArray(n) { series.times[it] })
        add("the rate of change, more at some times than at others" to moved(slope, age))
        add("the value, more at some times than at others" to listOf(times(value, age), times(value, power(age, 2))))
        if (series.isMoving) track(value, slope)
        for ((name, column) in scales.centred) {
            if (name == Conditions.HEADING) continue
            val condition = standard(column)
            add("$name" to listOf(condition, power(condition, 2)))
            add("the value, more at some values of $name than at others" to listOf(times(value, condition)))
        }
    }

    private fun MutableList<Pair<String, List<DoubleArray>>>.track(value: DoubleArray, slope: DoubleArray) {
        val heading = series.heading
        // A log without places, or a way that never turns, has no headings to differ between.
        if (heading.any { abs(sin((it - heading[0]) / 2)) > LEAST_TURN }) {
            val east = DoubleArray(n) { cos(heading[it]) }
            val north = DoubleArray(n) { sin(heading[it]) }
            val twice = DoubleArray(n) { cos(2 * heading[it]) }
            val twiceToo = DoubleArray(n) { sin(2 * heading[it]) }
            // Along a line, as up and down a profile, there are two.
            val isLine = series.hasPlaces && isFlat(series.y)
            val more = if (isLine) "more on the way there than back" else "more on some headings than on others"
            val way = if (isLine) "the way it goes, there or back" else "the heading"
            add(way to listOf(east, north, twice, twiceToo))
            add("the value, $more" to listOf(times(value, east), times(value, north)))
            add(
                "the rate of change, $more" to
                    listOf(followed(times(slope, east)), followed(times(slope, north))),
            )
        }
        val speed = standard(series.speed)
        add("the speed" to listOf(speed, power(speed, 2)))
        val x = standard(series.x)
        val y = standard(series.y)
        if (series.hasPlaces) {
            add("the position" to listOf(x, y, times(x, y), power(x, 2), power(y, 2)))
        }
    }

    /**
     * What a time constant that depends on [other], straight or curved, would add: its sources, as the lag shows
     * them.
     */
    private fun moved(slope: DoubleArray, other: DoubleArray) =
        listOf(followed(times(slope, other)), followed(times(slope, power(other, 2))))

    /** [column] seen through the base lag. */
    private fun followed(column: DoubleArray): DoubleArray {
        val tau = maxOf(fit.numbers[ResponseModel.TIME_CONSTANT], series.period / 50)
        var state = 0.0
        return DoubleArray(n) { i ->
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            state += -expm1(-dt / tau) * (column[i] - state)
            state
        }
    }

    /** The truth earlier by several shares of the response's time: any linear response is near a sum of these. */
    private fun response(): List<DoubleArray> {
        val truth = requireNotNull(series.reference) { "structure needs a reference" }
        val tau = maxOf(fit.numbers[ResponseModel.TIME_CONSTANT], series.period)
        return doubleArrayOf(0.0, 0.5, 1.0, 2.0, 4.0, 8.0).map { share ->
            var from = 0
            DoubleArray(n) { i ->
                while (from < i && series.times[i] - series.times[from + 1] >= share * tau) from++
                truth[from]
            }
        }
    }

    /** The likeliest of offsets that settle; neighbours among them are much the same. */
    private fun settling(): Dependence {
        val best = Settling.TIMES.map { test(SETTLES, listOf(Settling.column(series, it * series.duration))) }
            .minBy { it.pValue }
        val p = minOf(1.0, best.pValue * Settling.TIMES.size / ALIKE)
        return best.copy(pValue = p, adjusted = p)
    }

    /** The strongest of all frequencies that the log can tell apart. */
    private fun periodic(): Dependence {
        val highest = 0.4 / series.period
        val lowest = 3 / maxOf(series.duration, 1e-9)
        val count = minOf(((highest - lowest) * series.duration).toInt(), MOST_FREQUENCIES)
        if (count < 2) return Dependence("time, periodically", 0.0, 2, 1.0)
        val step = (highest - lowest) / (count - 1)
        val powers = DoubleArray(count) { explainedBy(lowest + step * it) }
        // Halfway between two of them a period shows less than half of its power in either.
        val near = powers.indices.sortedByDescending { powers[it] }.take(REFINED)
            .flatMap { k -> NEAR.map { lowest + step * (k + it) } }.associateWith(::explainedBy)
        val (frequency, best) = near.maxBy { it.value }
        val ratio = Evidence.ratio(square, square - best, fit.noise.rows)
        val p = minOf(1.0, Evidence.pValue(ratio, 2) * count * OVERSAMPLED)
        return Dependence("time, periodically (every %.3g s)".format(Locale.ROOT, 1 / frequency), ratio, 2, p)
    }

    /** What a wave of [frequency], Hz, explains of the whitened residuals' squares. */
    private fun explainedBy(frequency: Double): Double {
        var even = 0.0
        var odd = 0.0
        for (i in 0 until n) {
            val phase = 2 * PI * frequency * (series.times[i] - series.times[0])
            even += fit.whitened[i] * cos(phase)
            odd += fit.whitened[i] * sin(phase)
        }
        return 2 * (even * even + odd * odd) / n
    }

    private fun standard(column: DoubleArray): DoubleArray {
        val ordinary = if (isPart) column.filterIndexed { i, _ -> fit.noise.used[i] }.toDoubleArray() else column
        val mean = ordinary.average()
        val spread = sqrt(ordinary.sumOf { (it - mean) * (it - mean) } / ordinary.size)
        return DoubleArray(column.size) { if (spread > 0) ((column[it] - mean) / spread).coerceIn(-4.0, 4.0) else 0.0 }
    }

    private fun power(column: DoubleArray, exponent: Int) = DoubleArray(n) { i ->
        var product = 1.0
        repeat(exponent) { product *= column[i] }
        product
    }

    private fun absolute(column: DoubleArray) = DoubleArray(n) { abs(column[it]) }

    private fun times(a: DoubleArray, b: DoubleArray) = DoubleArray(n) { a[it] * b[it] }

    companion object {
        /**
         * All looks at what [fit] leaves, the most striking first. Where the sensor began far away, also at what it leaves once
         * it has settled, with correlation times up to [longest] s: of the two the surer, at twice its p-value.
         */
        fun dependences(fit: ModelFit, longest: Double): List<Dependence> {
            val settled = SettledStart.of(fit, longest)?.let { Structure(it, isPart = true).looks() }
            val tests = Structure(fit).looks().mapIndexed { i, look ->
                val surer = settled?.get(i)?.takeIf { it.pValue < look.pValue } ?: look
                if (settled == null) look else surer.copy(pValue = minOf(1.0, 2 * surer.pValue))
            }
            val adjusted = Evidence.holm(tests.map { it.pValue })
            return tests.mapIndexed { i, test -> test.copy(adjusted = adjusted[i]) }.sortedBy { it.pValue }
        }

        /** The description of what wanders slowly with time. */
        const val SLOW = "time (a slow wandering)"

        /** The description of an offset that moves and comes to rest. */
        const val SETTLES = "time (an offset that settles)"

        /** Six slow cosines over [series]. */
        fun slow(series: MeasuredSeries): List<DoubleArray> = (1..6).map { k ->
            DoubleArray(series.size) {
                cos(PI * k * (series.times[it] - series.times[0]) / maxOf(series.duration, 1e-9))
            }
        }

        /** Sine of half the angle between headings that are the same. */
        private const val LEAST_TURN = 1e-3

        /** Of times within which an offset settles, so many count as one. */
        private const val ALIKE = 2
        private const val MOST_FREQUENCIES = 2500

        /** Frequencies that are looked at more closely, in which places beside them, and as how many they count. */
        private const val REFINED = 4
        private val NEAR = listOf(-0.5, -0.25, 0.0, 0.25, 0.5)
        private const val OVERSAMPLED = 2
    }
}
