package stillwater.estimate

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Whether a corrected track agrees with itself where it comes to the same place again, as far as its intervals say.
 *
 * Of a response that is not the sensor's the intervals know nothing. But passes in other directions and at other speeds
 * then differ by more than the intervals allow, mostly where the water changes fast:
 *
 *     E (c₁ − c₂)² = s₁² + s₂² + a² (ċ₁² + ċ₂²) + 2 b²
 *
 * with s from the intervals, a what the time is wrong by and b what the value is wrong by, both fitted, none below 0.
 * Water that changed between the passes and fixes that are off count too: from the passes alone nobody can tell. Errors
 * that all passes share, such as detail that no pass shows, do not show here.
 *
 * @property crossings number of places that were compared. @property alike number of places that were not, because both
 * passes go the same way at the same speed, and so agree whatever the response.
 * @property places how many of [crossings] are different places.
 * @property ratio mean of (c₁ − c₂)² / (s₁² + s₂²), each at most [LARGEST]: 1 where the intervals hold; NaN below
 * [FEWEST] crossings, or where they agree in fewer different places than that.
 * @property error standard error of [ratio], from groups of crossings that follow each other.
 * @property lateness a, s. @property spread b, sensor units.
 */
public class TrackAgreement private constructor(
    public val crossings: Int,
    public val ratio: Double,
    public val error: Double,
    public val lateness: Double,
    public val spread: Double,
    private val slopes: DoubleArray,
    private val times: DoubleArray,
    public val alike: Int,
    public val places: Int,
) {
    /** Whether the passes differ by more than chance and the intervals explain. */
    public val isContradicted: Boolean get() = ratio > 1 + SURE * error && (lateness > 0 || spread > 0)

    /** [track] with intervals that [lateness] and [spread] are in; as it is unless it [isContradicted]. */
    public fun widened(track: CorrectedTrack): CorrectedTrack =
        if (isContradicted) widened(track, lateness, spread) else track

    /**
     * [track] with intervals that hold times wrong by [late], s, and values wrong by [wide], sensor units, as well: for
     * times not farther than the track goes within [CAP] times 1.96 [late] either way, which of a track that is still
     * smoothed is less than the water does.
     */
    public fun widened(track: CorrectedTrack, late: Double, wide: Double = 0.0): CorrectedTrack {
        val reach = TWO_SIDED * late
        val most = changes(track.values, CAP * reach)

        fun wider(half: Double, row: Int): Double {
            val shifted = minOf(reach * abs(slopes[row]), most[row])
            return sqrt(half * half + shifted * shifted + TWO_SIDED * TWO_SIDED * wide * wide)
        }
        val n = track.values.size
        return CorrectedTrack(
            track.values,
            DoubleArray(n) { track.values[it] - wider(track.values[it] - track.lower[it], it) },
            DoubleArray(n) { track.values[it] + wider(track.upper[it] - track.values[it], it) },
            track.silent,
            track.outlying,
            track.clipped,
        )
    }

    /** By how much [values] differ at the most from each within [reach], s, or two rows of it; linear in their number. */
    private fun changes(values: DoubleArray, reach: Double): DoubleArray {
        val most = DoubleArray(values.size)
        for (sign in listOf(1, -1)) {
            // Rows that may yet be the largest within reach, in falling order of their values.
            val rows = ArrayDeque<Int>()
            var next = 0
            for (row in values.indices) {
                while (next < values.size && (next <= row + SLOPE_ROWS || times[next] <= times[row] + reach)) {
                    while (rows.isNotEmpty() && sign * values[rows.last()] <= sign * values[next]) rows.removeLast()
                    rows.addLast(next++)
                }
                while (rows.first() < row - SLOPE_ROWS && times[rows.first()] < times[row] - reach) rows.removeFirst()
                most[row] = maxOf(most[row], sign * (values[rows.first()] - values[row]))
            }
        }
        return most
    }

    public companion object {
        /** Fewer crossings show nothing. */
        public const val FEWEST: Int = 10

        /** Squares beyond so many times what is expected count as that: one place is not to widen all intervals. */
        public const val LARGEST: Double = 25.0

        /** Times the reach within which what the track does caps what wrong times may do. */
        private const val CAP = 2.0
        private const val TWO_SIDED = 1.96
        private const val SURE = 2.0
        private const val GROUPS = 20
        private const val ROUNDS = 5

        private const val SLOPE_ROWS = 2

        /** How [track], the correction of [series], agrees with itself. Some milliseconds for 5000 readings. */
        public fun of(series: TrackSeries, track: CorrectedTrack): TrackAgreement {
            val slopes = slopes(series, track.values)
            val found = TrackCrossings(series.withFreshPositions())
            if (found.size < FEWEST) {
                val none = Double.NaN
                return TrackAgreement(
                    found.size,
                    none,
                    none,
                    0.0,
                    0.0,
                    slopes,
                    series.times,
                    found.alike,
                    found.places,
                )
            }
            val pairs = Pairs(found, track, slopes)
            val ratio = pairs.ratio()
            val (late, wide) = pairs.fit()
            val error = pairs.error(ratio)
            // That one place agrees with itself again and again is no check; that it does not is.
            val isShown = found.places >= FEWEST || ratio > 1 + SURE * error
            return TrackAgreement(
                found.size,
                if (isShown) ratio else Double.NaN,
                error,
                sqrt(late),
                sqrt(wide),
                slopes,
                series.times,
                found.alike,
                found.places,
            )
        }

        /** Rates of change of [values], 1/s: over two rows either way, none over a gap. */
        private fun slopes(series: TrackSeries, values: DoubleArray) = DoubleArray(values.size) { i ->
            var from = i
            while (from > 0 && i - from < SLOPE_ROWS && series.isJoined(from - 1)) from--
            var to = i
            while (to < values.size - 1 && to - i < SLOPE_ROWS && series.isJoined(to)) to++
            if (to > from) (values[to] - values[from]) / (series.times[to] - series.times[from]) else 0.0
        }

        private fun TrackSeries.isJoined(i: Int) = times[i + 1] - times[i] <= gapLimit
    }

    /** What the two passes say at each crossing, in the order of the earlier pass. */
    private class Pairs(found: TrackCrossings, track: CorrectedTrack, slopes: DoubleArray) {
        private val order = (0 until found.size).sortedBy { found.one(it) }
        private val squares = DoubleArray(order.size)
        private val allowed = DoubleArray(order.size)
        private val changes = DoubleArray(order.size)

        init {
            order.forEachIndexed { n, k ->
                fun one(of: (Int) -> Double) = between(of, found.one(k), found.shareOne(k))
                fun other(of: (Int) -> Double) = between(of, found.other(k), found.shareOther(k))
                fun spread(row: Int) = (track.upper[row] - track.lower[row]) / (2 * TWO_SIDED)
                squares[n] = square(one { track.values[it] } - other { track.values[it] })
                allowed[n] = square(one(::spread)) + square(other(::spread))
                changes[n] = square(one { slopes[it] }) + square(other { slopes[it] })
            }
            // Two intervals of no width allow nothing, which no division stands: if none has any, then so little that
            // passes that differ at all contradict them.
            val least = allowed.filter { it > 0 }.minOrNull()
                ?: (squares.average() / LARGEST).takeIf { it > 0 } ?: 1.0
            for (n in allowed.indices) allowed[n] = maxOf(allowed[n], least)
        }

        private fun between(of: (Int) -> Double, row: Int, share: Double) = (1 - share) * of(row) + share * of(row + 1)

        private fun square(number: Double) = number * number

        private fun ratio(n: Int) = minOf(squares[n] / allowed[n], LARGEST)

        fun ratio() = squares.indices.sumOf(::ratio) / squares.size

        fun error(ratio: Double): Double {
            val sums = DoubleArray(GROUPS)
            for (n in squares.indices) {
                sums[(n.toLong() * GROUPS / squares.size).toInt()] += ratio(n) - ratio
            }
            return sqrt(sums.sumOf { it * it } * GROUPS / (GROUPS - 1)) / squares.size
        }

        /** a² and b² of the class, by least squares with the weights that they give. */
        fun fit(): Pair<Double, Double> {
            var late = 0.0
            var wide = 0.0
            repeat(ROUNDS) { round ->
                var aa = 0.0
                var ab = 0.0
                var bb = 0.0
                var ay = 0.0
                var by = 0.0
                for (n in squares.indices) {
                    val expected = allowed[n] + late * changes[n] + 2 * wide
                    val weight = 1 / expected
                    val a = changes[n] * weight
                    val b = 2 * weight
                    // The first round knows no measure yet.
                    val square = if (round == 0) squares[n] else minOf(squares[n], LARGEST * expected)
                    val y = (square - allowed[n]) * weight
                    aa += a * a
                    ab += a * b
                    bb += b * b
                    ay += a * y
                    by += b * y
                }
                val determinant = aa * bb - ab * ab
                val first = if (determinant > 0) (ay * bb - by * ab) / determinant else -1.0
                val second = if (determinant > 0) (by * aa - ay * ab) / determinant else -1.0
                if (first >= 0 && second >= 0) {
                    late = first
                    wide = second
                } else {
                    // One of them alone, whichever explains more.
                    val lateAlone = if (aa > 0) maxOf(0.0, ay / aa) else 0.0
                    val wideAlone = maxOf(0.0, by / bb)
                    val byLate = lateAlone * ay >= wideAlone * by
                    late = if (byLate) lateAlone else 0.0
                    wide = if (byLate) 0.0 else wideAlone
                }
            }
            return late to wide
        }
    }
}
