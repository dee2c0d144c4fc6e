package stillwater.survey

import stillwater.io.ReadingSink
import stillwater.model.BoatTime
import stillwater.model.Conditions
import kotlin.math.hypot

/**
 * The first look at a log: takes every reading once, keeps extremes, counts and an even sample of the track.
 *
 * Confined to one thread; memory does not grow with the log beyond 2^18 points.
 */
class SurveyScan : ReadingSink {
    private val points = ThinnedSamples(width = 4)
    private val steps = ThinnedSamples(width = 1)
    private val speeds = ThinnedSamples(width = 1)
    private val bends = FixBends()
    private var readings = 0L
    private var first = Double.NaN
    private var last = Double.NaN
    private var lastX = Double.NaN
    private var lastY = Double.NaN
    private var lastValue = Double.NaN
    private var longestStep = 0.0
    private var repeatedFixes = 0L
    private var repeatedValues = 0L
    private var west = Double.POSITIVE_INFINITY
    private var east = Double.NEGATIVE_INFINITY
    private var south = Double.POSITIVE_INFINITY
    private var north = Double.NEGATIVE_INFINITY
    private var lowest = Double.POSITIVE_INFINITY
    private var highest = Double.NEGATIVE_INFINITY

    // Start of the stretch over which the speed is being taken.
    private var anchorTime = Double.NaN
    private var anchorX = Double.NaN
    private var anchorY = Double.NaN
    private var distance = 0.0

    override fun take(time: BoatTime, x: Double, y: Double, value: Double, conditions: Conditions) {
        val seconds = time.seconds
        if (readings == 0L) {
            first = seconds
            anchor(seconds, x, y)
        } else {
            step(seconds, x, y, value)
        }
        bends.take(x, y)
        readings++
        last = seconds
        lastX = x
        lastY = y
        lastValue = value
        if (x < west) west = x
        if (x > east) east = x
        if (y < south) south = y
        if (y > north) north = y
        if (value < lowest) lowest = value
        if (value > highest) highest = value
        if (points.wantsNext()) keep(seconds, x, y, value)
    }

    private fun step(seconds: Double, x: Double, y: Double, value: Double) {
        val step = seconds - last
        steps.offer(step)
        if (step > longestStep) longestStep = step
        if (x == lastX && y == lastY) repeatedFixes++
        if (value == lastValue) repeatedValues++
        // Over a gap nothing is known about the way.
        if (readings > 2 && step > GAP_SECONDS && step > GAP_STEPS * (last - first) / (readings - 1)) {
            distance += sinceAnchor()
            return anchor(seconds, x, y)
        }
        val elapsed = seconds - anchorTime
        if (elapsed >= SPEED_SECONDS) {
            val run = hypot(x - anchorX, y - anchorY)
            distance += run
            speeds.offer(run / elapsed)
            anchor(seconds, x, y)
        }
    }

    /** The way of a stretch too short for a speed, m. */
    private fun sinceAnchor() = hypot(lastX - anchorX, lastY - anchorY)

    private fun anchor(seconds: Double, x: Double, y: Double) {
        anchorTime = seconds
        anchorX = x
        anchorY = y
    }

    private fun keep(seconds: Double, x: Double, y: Double, value: Double) {
        val row = points.put()
        points[row, 0] = seconds
        points[row, 1] = x
        points[row, 2] = y
        points[row, 3] = value
    }

    /** What was seen so far; needs two readings. */
    fun statistics(): SurveyStatistics {
        check(readings >= 2) { "statistics need at least 2 readings, there are $readings" }
        // Sorted here, once: what is in order is sorted again in no time.
        val values = points.column(3).apply { sort() }
        return SurveyStatistics(
            readings = readings,
            startTime = first,
            duration = last - first,
            steps = Quantiles(steps.column(0)),
            longestStep = longestStep,
            speeds = Quantiles(speeds.column(0)),
            distance = distance + sinceAnchor(),
            repeatedFixes = repeatedFixes / (readings - 1.0),
            fixScatter = bends.scatter(),
            repeatedValues = repeatedValues / (readings - 1.0),
            west = west,
            east = east,
            south = south,
            north = north,
            lowest = lowest,
            highest = highest,
            values = Quantiles(values),
            resolution = ValueResolution.of(values),
        )
    }

    /** The track so far, at most 2^18 points. */
    fun track(): Track = Track(points.column(0), points.column(1), points.column(2), points.column(3), points.stride)

    private companion object {
        const val SPEED_SECONDS = 5.0
        const val GAP_SECONDS = 60.0
        const val GAP_STEPS = 10
    }
}
