package stillwater.control

import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * How good a boat's fixes are and how fast its surroundings change, as [TrackEstimator] is told.
 *
 * @property fixDeviation standard deviation of a fix, each axis, m, above 0.
 * @property driftChange how much the drift wanders, m/s per √s, above 0: current, wind, and speed wrongly believed.
 * @property largestDrift standard deviation of the drift before anything is known, m/s, above 0.
 * @property gate a fix farther than this many standard deviations from where it is expected is refused, above 0.
 * @throws IllegalArgumentException if one is not above 0 and finite.
 */
public data class TrackSettings(
    val fixDeviation: Double = 1.5,
    val driftChange: Double = 0.02,
    val largestDrift: Double = 0.5,
    val gate: Double = 6.0,
) {
    init {
        for ((name, value) in listOf(
            "fixDeviation (m)" to fixDeviation,
            "driftChange (m/s per root s)" to driftChange,
            "largestDrift (m/s)" to largestDrift,
            "gate" to gate,
        )) {
            require(value > 0 && value.isFinite()) { "$name ($value) must be above 0 and finite" }
        }
    }
}

/** What became of a fix. */
public enum class FixUse {
    /** It was taken. */
    USED,

    /** It lay farther from where it was expected than noise and motion explain. */
    JUMPED,

    /** It was not finite. */
    NOT_FINITE,
}

/**
 * Where the boat is and how the water carries it, from fixes, heading and speed through the water.
 *
 * A Kalman filter an axis: position p and drift c, with ṗ = w + c, w the velocity through the water from compass and
 * thrust, c a random walk. What the speed is wrongly believed ends up in c, which is what a course needs. Both axes
 * have the same covariance. White fix noise is assumed: an error that stays for a minute is followed, whatever the
 * filter.
 *
 * Source: Kalman (1960), doi:10.1115/1.3662552; derivation in core/docs/WaypointFollower.md. Never throws on data. No
 * allocation. Confined to one thread.
 *
 * @property settings noise and limits.
 */
public class TrackEstimator(public val settings: TrackSettings = TrackSettings()) {
    /** Metres east; NaN before the first fix. */
    public var x: Double = Double.NaN
        private set

    /** Metres north; NaN before the first fix. */
    public var y: Double = Double.NaN
        private set

    /** Drift of the water and whatever else carries the boat, east, m/s. */
    public var driftX: Double = 0.0
        private set

    /** Drift, north, m/s. */
    public var driftY: Double = 0.0
        private set

    /** Velocity over ground, east, m/s. */
    public var velocityX: Double = 0.0
        private set

    /** Velocity over ground, north, m/s. */
    public var velocityY: Double = 0.0
        private set

    /** Fixes refused in a row. */
    public var jumps: Int = 0
        private set

    /**
     * How far the boat may be from where it is believed to be, besides its deviation, m: as far as fixes have lately
     * moved that place, where they were off to one side for longer than chance explains; 0 where they were not. Then
     * they were wrong before or are wrong now, which nothing but later ones tell. Fades with time.
     */
    public var doubt: Double = 0.0
        private set

    private var pp = 0.0
    private var pc = 0.0
    private var cc = 0.0
    private var sinceFix = 0.0
    private var movedX = 0.0
    private var movedY = 0.0
    private var turnedX = 0.0
    private var turnedY = 0.0
    private var offX = 0.0
    private var offY = 0.0
    private var offVariance = 0.0

    /** Whether a fix was taken since the start or the last [reset]. */
    public val isKnown: Boolean get() = !x.isNaN()

    /** Standard deviation of the position, each axis, m; infinite before the first fix. */
    public val deviation: Double get() = if (isKnown) sqrt(pp) else Double.POSITIVE_INFINITY

    /**
     * Lets [dt] s pass; not above 0, or what is not finite, changes nothing.
     *
     * @param heading rad, counter-clockwise from east.
     * @param speed through the water, m/s.
     */
    public fun advance(dt: Double, heading: Double, speed: Double) {
        if (!(dt > 0 && dt.isFinite()) || !isKnown) return
        val through = if (heading.isFinite() && speed.isFinite()) speed else 0.0
        velocityX = driftX + if (through == 0.0) 0.0 else through * cos(heading)
        velocityY = driftY + if (through == 0.0) 0.0 else through * sin(heading)
        x += velocityX * dt
        y += velocityY * dt
        sinceFix += dt
        // P ← F P Fᵀ + Q, F = [1 dt; 0 1]
        val q = settings.driftChange * settings.driftChange
        pp += dt * (2 * pc + dt * cc) + q * dt * dt * dt / 3
        pc += dt * cc + q * dt * dt / 2
        cc += q * dt
    }

    /** Takes a fix at ([fixX], [fixY]), m, of this moment. */
    public fun fix(fixX: Double, fixY: Double): FixUse {
        if (!fixX.isFinite() || !fixY.isFinite()) return FixUse.NOT_FINITE
        val r = settings.fixDeviation * settings.fixDeviation
        if (!isKnown) {
            x = fixX
            y = fixY
            pp = r
            pc = 0.0
            cc = settings.largestDrift * settings.largestDrift
            return FixUse.USED
        }
        val s = pp + r
        val errorX = fixX - x
        val errorY = fixY - y
        if (hypot(errorX, errorY) > settings.gate * sqrt(s)) {
            jumps++
            return FixUse.JUMPED
        }
        jumps = 0
        val gainP = pp / s
        val gainC = pc / s
        x += gainP * errorX
        y += gainP * errorY
        watchMoves(errorX, errorY, s, gainP, gainC)
        driftX += gainC * errorX
        driftY += gainC * errorY
        cc -= gainC * pc
        pc *= 1 - gainP
        pp *= 1 - gainP
        return FixUse.USED
    }

    /**
     * Errors e of fixes are white where the filter is right, of variance s. With κ = exp(−Δ / 8 s) their sum
     * A ← κ A + e / √s has the variance N ← κ² N + 1; |A| above 3 √N is chance in 1.1 % of fixes, with two axes, and
     * the place is doubted by |C|, what fixes have moved it by: C ← λ (C + D Δ) + K e, with D ← λ D + K_c e, what
     * they have changed the drift by, and λ = exp(−Δ / 15 s).
     */
    private fun watchMoves(errorX: Double, errorY: Double, s: Double, gainP: Double, gainC: Double) {
        val kept = exp(-sinceFix / REMEMBERED)
        movedX = kept * (movedX + turnedX * sinceFix) + gainP * errorX
        movedY = kept * (movedY + turnedY * sinceFix) + gainP * errorY
        turnedX = kept * turnedX + gainC * errorX
        turnedY = kept * turnedY + gainC * errorY
        val summed = exp(-sinceFix / SUMMED)
        offX = summed * offX + errorX / sqrt(s)
        offY = summed * offY + errorY / sqrt(s)
        offVariance = summed * summed * offVariance + 1
        doubt *= exp(-sinceFix / FADING)
        if (doubt < LEAST_DOUBT) doubt = 0.0
        if (hypot(offX, offY) > UNLIKELY * sqrt(offVariance)) doubt = maxOf(doubt, hypot(movedX, movedY))
        sinceFix = 0.0
    }

    /** Forgets everything: the next fix starts anew. */
    public fun reset() {
        x = Double.NaN
        y = Double.NaN
        driftX = 0.0
        driftY = 0.0
        velocityX = 0.0
        velocityY = 0.0
        jumps = 0
        doubt = 0.0
        sinceFix = 0.0
        movedX = 0.0
        movedY = 0.0
        turnedX = 0.0
        turnedY = 0.0
        offX = 0.0
        offY = 0.0
        offVariance = 0.0
    }

    /** Speed over ground, m/s. */
    public val groundSpeed: Double get() = hypot(abs(velocityX), abs(velocityY))

    private companion object {
        /** As long as a place takes to be believed at first, s. */
        const val REMEMBERED = 15.0

        /** In which a doubt falls to 1/e where fixes agree again, s: the place comes back in about half of that. */
        const val FADING = 20.0

        /** Less than this the deviation's multiples cover, m. */
        const val LEAST_DOUBT = 0.5

        /** Seconds of fixes whose errors are summed: about as long as the filter takes to follow a jump, s. */
        const val SUMMED = 8.0

        /** Standard deviations: more would miss jumps, fewer take water that changes for them (TrackEstimatorTest). */
        const val UNLIKELY = 3.0
    }
}
