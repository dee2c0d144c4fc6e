package stillwater.closedloop

import stillwater.mission.BoardClock
import stillwater.model.BoatTime
import stillwater.model.LatLon
import stillwater.virtual.VirtualBoat
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sin
import kotlin.random.Random

/** Lets the faults of [kinds] befall a boat, each now and then, and counts them. */
internal class Faults(
    private val kinds: Set<FaultKind>,
    private val boat: VirtualBoat,
    private val link: FaultyLink,
    private val random: Random,
) {
    val occurred = IntArray(FaultKind.entries.size)

    /** Stamps of a board's counter that [BoardClock] made wrong. */
    var wrongStamps = 0
        private set

    /** Whether bytes pass both ways. */
    var isLinked = true
        private set

    private val clock = BoardClock()
    private val counterStart = (1L shl 32) - random.nextLong(1000, 100_000)
    private var deafUntil = 0.0
    private var muteUntil = 0.0
    private var isCutWhole = false
    private var noFixUntil = 0.0
    private var stuckUntil = 0.0
    private var stuckAt: String? = null
    private var nanUntil = 0.0
    private var sagUntil = Double.NaN
    private var jumpsLeft = 0
    private var jumpEast = 0.0
    private var jumpNorth = 0.0
    private val soundVolts = boat.board.volts

    init {
        if (FaultKind.CORRUPTION in kinds) link.corruption = logarithmic(1e-4, 1e-2)
        link.spoilt = ::spoil
    }

    /** Once a step, before the mission's. */
    fun strike(now: Double) {
        if (now < QUIET) return
        cut(now)
        if (begins(FaultKind.STUCK_READING, STUCK_EVERY, now >= stuckUntil)) {
            stuckUntil = now + random.nextDouble(10.0, 60.0)
            stuckAt = null
        }
        if (begins(FaultKind.NOT_A_NUMBER, OFTEN, now >= nanUntil)) nanUntil = now + random.nextDouble(0.5, 6.0)
        if (begins(FaultKind.BOARD_RESET, SELDOM, true)) boat.board.reset()
        sag(now)
        if (FaultKind.CLOCK_WRAP in kinds) stamp(now)
        occurred[FaultKind.CORRUPTION.ordinal] = link.changedBytes.toInt()
    }

    /** [place] as the phone is told; null where it is told of none. */
    fun fix(place: LatLon): LatLon? {
        if (isWithoutFix()) return null
        if (boat.time.seconds > QUIET && begins(FaultKind.FIX_JUMP, JUMP_EVERY, jumpsLeft == 0)) {
            jump(random.nextInt(1, 11), logarithmic(5.0, 2000.0))
        }
        if (jumpsLeft == 0) return place
        jumpsLeft--
        return LatLon(place.latitudeDeg + jumpNorth, place.longitudeDeg + jumpEast)
    }

    private fun isWithoutFix(): Boolean {
        val now = boat.time.seconds
        if (now > QUIET && begins(FaultKind.FIX_OUTAGE, OUTAGE_EVERY, now >= noFixUntil)) {
            noFixUntil = now + logarithmic(3.0, 90.0)
            if (random.nextBoolean()) jump(random.nextInt(1, 4), logarithmic(5.0, 60.0))
        }
        return now < noFixUntil
    }

    private fun jump(fixes: Int, size: Double) {
        jumpsLeft = fixes
        val angle = random.nextDouble(2 * PI)
        jumpEast = size * cos(angle) / METRES_PER_DEGREE
        jumpNorth = size * sin(angle) / METRES_PER_DEGREE
    }

    /** [value] of a fix's time as the phone is told: of a time to come besides what befalls other numbers. */
    fun time(value: Double): Double {
        val told = number(value)
        return if (told.isNaN()) value + random.nextDouble(0.0, 1000.0) else told
    }

    /** [value] of a heading or a rate as the phone is told. */
    fun number(value: Double): Double = when {
        boat.time.seconds >= nanUntil || random.nextBoolean() -> value
        random.nextBoolean() -> Double.NaN
        else -> Double.POSITIVE_INFINITY
    }

    private fun cut(now: Double) {
        if (begins(FaultKind.LINK_CUT, OFTEN, isLinked)) {
            val until = now + logarithmic(0.1, 60.0)
            val kind = random.nextInt(4)
            if (kind != 1) deafUntil = until
            if (kind != 0) muteUntil = if (kind == 2) now + logarithmic(0.1, 60.0) else until
            isCutWhole = kind == 3
        }
        link.isDeaf = now < deafUntil
        link.isMute = now < muteUntil
        isLinked = !link.isDeaf && !link.isMute
        boat.link.isCut = isCutWhole && !isLinked
    }

    private fun sag(now: Double) {
        if (FaultKind.BATTERY_SAG !in kinds) return
        if (sagUntil.isNaN() && begins(FaultKind.BATTERY_SAG, OFTEN, true)) {
            // Shorter than a low battery has to last, or for good.
            sagUntil = if (random.nextInt(3) > 0) now + random.nextDouble(0.5, 8.0) else Double.POSITIVE_INFINITY
            boat.board.volts = random.nextDouble(9.0, 11.9)
        }
        if (now > sagUntil) {
            sagUntil = Double.NaN
            boat.board.volts = soundVolts
        }
    }

    private fun spoil(truth: String): String? {
        val now = boat.time.seconds
        if (now < nanUntil) return listOf("nan", "-inf", "", "1e999", "NaN", "--").random(random)
        if (now >= stuckUntil) return null
        if (stuckAt == null) stuckAt = truth
        return stuckAt
    }

    /** Platypus lines carry no stamp, so a board's that does stamps them beside the mission. */
    private fun stamp(now: Double) {
        val counter = (counterStart + (now * 1000).toLong()) % (1L shl 32)
        if (counter < 100) occurred[FaultKind.CLOCK_WRAP.ordinal]++
        val heard = now + random.nextDouble(0.0, LONGEST_DELAY)
        val sampled = clock.sampled(counter, BoatTime(heard)).seconds
        // Never after it was heard, and off by no more than the least delay seen and a counter's tick.
        if (!(sampled <= heard && sampled >= now - 0.002 && sampled <= now + LONGEST_DELAY)) wrongStamps++
    }

    private fun begins(kind: FaultKind, every: Double, may: Boolean): Boolean {
        val step = if (kind == FaultKind.FIX_JUMP || kind == FaultKind.FIX_OUTAGE) 1.0 else 0.1
        if (kind !in kinds || random.nextDouble() >= step / every || !may) return false
        occurred[kind.ordinal]++
        return true
    }

    private fun logarithmic(from: Double, to: Double) = exp(random.nextDouble(ln(from), ln(to)))

    private companion object {
        /** Faults begin with the mission, s. */
        const val QUIET = 3.0
        const val OFTEN = 30.0
        const val JUMP_EVERY = 30.0
        const val OUTAGE_EVERY = 60.0
        const val STUCK_EVERY = 60.0
        const val SELDOM = 80.0
        const val LONGEST_DELAY = 0.2
        const val METRES_PER_DEGREE = 111_000.0
    }
}
