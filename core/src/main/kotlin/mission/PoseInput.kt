package stillwater.mission

import stillwater.control.FixUse
import stillwater.control.Mixing
import stillwater.control.Situation
import stillwater.control.TrackEstimator
import stillwater.control.WaterSpeed
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import kotlin.math.abs

/**
 * Where the boat is, from the phone's fixes and compass and what its thrusters do. Confined to one thread.
 *
 * @property frame in which the track has its metres.
 * @property track the estimate.
 * @param oldestFix after a pause between two fixes of more than twice this they have to agree again, s.
 */
internal class PoseInput(
    val frame: LocalFrame,
    topSpeed: Double,
    private val mixing: Mixing,
    private val oldestFix: Double = 3.0,
) {
    val track = TrackEstimator()
    private var fixTime = Double.NEGATIVE_INFINITY

    /** What the last fix taken was stamped, s: ahead of [fixTime] where its clock is. */
    private var stamp = Double.NEGATIVE_INFINITY
    private var compassTime = Double.NEGATIVE_INFINITY
    private var lastHeading = Double.NaN
    private var waiting: LatLon? = null
    private var waitingTime = Double.NaN
    private val speed = WaterSpeed(topSpeed)
    private var now = 0.0
    private var agreeSince = Double.NaN
    private var isBelieved = false
    private var agreement = AGREEMENT

    /** Fixes refused: not finite, older than one before, too old, of a time to come, or where the boat cannot be. */
    var refused = 0L
        private set

    /** Yaw rate, rad/s; NaN before it was known. */
    var yawRate = Double.NaN
        private set

    /** Heading, rad; NaN where none was heard lately. */
    val heading: Double get() = if (now - compassTime <= OLDEST_COMPASS) lastHeading else Double.NaN

    /** Of several fixes between two steps, as after a hiccup of the link to the receiver, the newest tells the most. */
    fun fix(time: BoatTime, place: LatLon) {
        // A receiver says one fix in two sentences, whose times differ by rounding.
        if (abs(time.seconds - stamp) < SAME_FIX || abs(time.seconds - waitingTime) < SAME_FIX) return
        val isNewer = time.seconds > stamp && !(time.seconds <= waitingTime)
        if (!isNewer || !time.seconds.isFinite()) {
            refused++
            return
        }
        waiting = place
        waitingTime = time.seconds
    }

    fun compass(time: BoatTime, heading: Double, yawRate: Double) {
        if (!time.seconds.isFinite() || !heading.isFinite()) return
        compassTime = time.seconds
        lastHeading = heading
        this.yawRate = yawRate
    }

    /**
     * Lets [dt] s pass until [now] under [drive], and takes the fix that came meanwhile. A phone that slept told the
     * board nothing: its watchdog has put the motors to rest, and the boat came to rest in the water.
     */
    fun advance(now: BoatTime, dt: Double, drive: Drive) {
        this.now = now.seconds
        // What a clock in the future stamped would never grow old.
        compassTime = minOf(compassTime, now.seconds)
        var left = dt
        var ahead = mixing.ahead(drive)
        while (left > 0) {
            val step = if (ahead > 0 || speed.value > STILL) minOf(left, WATCHDOG) else left
            speed.advance(step, ahead)
            track.advance(step, heading, speed.value)
            left -= step
            ahead = 0.0
        }
        waiting?.let { take(it) }
        waiting = null
    }

    private fun take(place: LatLon) {
        val stamped = waitingTime
        waitingTime = Double.NaN
        val late = now - stamped
        if (late < -FAST_CLOCK || late > PAUSE * oldestFix) {
            refused++
            return
        }
        val local = frame.toLocal(place)
        // The boat went on since.
        val since = maxOf(0.0, late)
        if (track.fix(local.x + since * track.velocityX, local.y + since * track.velocityY) != FixUse.USED) {
            refused++
            doubt()
            return
        }
        stamp = stamped
        val time = minOf(stamped, now)
        // The longer without a fix, the farther off the first one may be that is taken.
        if (time - fixTime > PAUSE * oldestFix) {
            isBelieved = false
            agreeSince = Double.NaN
        }
        fixTime = time
        if (agreeSince.isNaN()) agreeSince = time
        if (time - agreeSince >= agreement) {
            isBelieved = true
            agreement = RENEWED
        }
    }

    /** The first fix after a start or a pause may be the wrong one: until a place is believed, another takes over soon. */
    private fun doubt() {
        if (isBelieved) return
        agreeSince = Double.NaN
        if (track.jumps <= MOST_JUMPS) return
        track.reset()
        agreement = AGREEMENT
    }

    /** Whether where the boat is believed to be is nothing to sail by: fixes are too old, or do not agree yet. */
    val isDoubted: Boolean get() = fixAge > oldestFix

    private val fixAge: Double get() = if (isBelieved) now - fixTime else Double.POSITIVE_INFINITY

    /** Fills in what [situation] has of the pose. */
    fun describe(situation: Situation) {
        situation.fixAge = fixAge
        situation.jumps = track.jumps
        situation.x = track.x
        situation.y = track.y
        situation.deviation = track.deviation
        situation.doubt = track.doubt
        situation.velocityX = track.velocityX
        situation.velocityY = track.velocityY
        situation.heading = heading
    }

    private companion object {
        /** For so long fixes agree before the boat moves, s: receivers wander most while they settle. */
        const val AGREEMENT = 15.0

        /** The same after a pause, s, where they agree with what was believed before it. */
        const val RENEWED = 5.0

        /** Of the age at which a fix is too old to drive by: a receiver that says one each 3 s makes no pauses. */
        const val PAUSE = 2.0

        /** Fixes nearer in time are one, s. */
        const val SAME_FIX = 0.02

        /** So far ahead of the boat's clock a fix may be stamped, s. */
        const val FAST_CLOCK = 1.0

        /** Fixes refused in a row that an unbelieved place survives. */
        const val MOST_JUMPS = 2

        /** Boards rest their motors so long after the last word, s; 3 s on firmware 4.2.0. */
        const val WATCHDOG = 0.5

        /** Slower than this through the water is at rest, m/s. */
        const val STILL = 0.01

        /** A compass that has not spoken for so long is not one, s. */
        const val OLDEST_COMPASS = 1.0
    }
}
