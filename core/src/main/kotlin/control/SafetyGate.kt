package stillwater.control

import stillwater.model.Drive
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sign
import kotlin.math.sin

/** What the boat does when it may not go on. */
public enum class Failsafe {
    /** Stays where it is, under power. */
    HOLD,

    /** Goes home. */
    RETURN_HOME,

    /** Rests its motors and drifts. */
    STOP,
}

/** Why the boat may not go on, the gravest first. */
public enum class Danger {
    /** A person said so. */
    OPERATOR_STOP,

    /** The board did not say for too long that it obeys: its motor lines under way, anything before. */
    LINK_LOST,

    /** No fix for too long, or not yet long enough that they agree. */
    FIX_STALE,

    /** Fixes lie where the boat cannot be. */
    FIX_JUMPING,

    /** No way home is left on which the boat gets on. */
    STRANDED,

    /** The boat was held up on every way home that it tried, and rests before it tries again. */
    HELD_UP,

    /** The boat is beyond the fence. */
    FENCE,

    /** The boat's battery was low for too long. */
    BATTERY_LOW,

    /** The battery of the phone that steers was low for too long. */
    PHONE_LOW,

    /** What is measured can no longer be written down. */
    LOG_LOST,

    /** A person wants the boat to wait, motors at rest. */
    OPERATOR_WAIT,

    /** A person wants the boat to stay where it is, under power. */
    OPERATOR_HOLD,

    /** A person wants the boat to come home. */
    OPERATOR_RETURN,

    /** What is left of the budget is needed for the way home. */
    BUDGET_SPENT,

    /** The mission is over. */
    MISSION_END,
}

/**
 * Limits and answers of a [SafetyGate].
 *
 * @property longestSilence of the board, s, above 0; while its motors have power it speaks at about 10 Hz. With two
 *   steps of 0.1 s, of which a line that is hit on the way takes one, motors rest within 0.6 s of a lost link.
 * @property oldestFix s, above 0.
 * @property mostJumps fixes refused in a row that are borne, at least 0.
 * @property fenceMargin how far beyond the fence the boat may be led back under power, m, at least 0; where it may be
 *   farther out, by [deviations] of its position and its doubt, the motors rest.
 * @property stopTime time constant with which the boat loses its way, motors at rest, s, at least 0.
 * @property reaction time from a decision to its effect on the motors, s, at least 0.
 * @property deviations standard deviations of the position that are kept from the fence on top, at least 0; its doubt
 *   is as well.
 * @property lowestVolts below which the boat's battery is low, V; 0 where none is measured.
 * @property lowFor a battery is low after so long below, s, at least 0: thrust makes the voltage sag.
 * @property lowestPhonePercent below which the phone's battery is low, percent; 0 where it is not watched.
 * @property answers what to do in each danger; what is not among them is [Failsafe.STOP].
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class SafetySettings(
    val longestSilence: Double = 0.4,
    val oldestFix: Double = 3.0,
    val mostJumps: Int = 2,
    val fenceMargin: Double = 5.0,
    val stopTime: Double = 3.0,
    val reaction: Double = 0.7,
    val deviations: Double = 3.0,
    val lowestVolts: Double = 0.0,
    val lowFor: Double = 10.0,
    val lowestPhonePercent: Double = 0.0,
    val answers: Map<Danger, Failsafe> = mapOf(
        Danger.BATTERY_LOW to Failsafe.RETURN_HOME,
        Danger.PHONE_LOW to Failsafe.RETURN_HOME,
        Danger.FENCE to Failsafe.RETURN_HOME,
        Danger.LOG_LOST to Failsafe.RETURN_HOME,
        Danger.OPERATOR_HOLD to Failsafe.HOLD,
        Danger.OPERATOR_RETURN to Failsafe.RETURN_HOME,
        Danger.BUDGET_SPENT to Failsafe.RETURN_HOME,
        Danger.MISSION_END to Failsafe.RETURN_HOME,
    ),
) {
    init {
        require(longestSilence > 0 && longestSilence.isFinite()) {
            "longestSilence ($longestSilence s) must be above 0 and finite"
        }
        require(oldestFix > 0 && oldestFix.isFinite()) { "oldestFix ($oldestFix s) must be above 0 and finite" }
        require(mostJumps >= 0) { "mostJumps ($mostJumps fixes) must be at least 0" }
        for ((name, value) in listOf(
            "fenceMargin (m)" to fenceMargin,
            "stopTime (s)" to stopTime,
            "reaction (s)" to reaction,
            "deviations" to deviations,
            "lowestVolts (V)" to lowestVolts,
            "lowFor (s)" to lowFor,
            "lowestPhonePercent (%)" to lowestPhonePercent,
        )) {
            require(value >= 0 && value.isFinite()) { "$name ($value) must be at least 0 and finite" }
        }
        require(lowestPhonePercent <= FULL) { "lowestPhonePercent (%) ($lowestPhonePercent) must be at most $FULL" }
    }

    private companion object {
        const val FULL = 100.0
    }
}

/**
 * What the gate looks at; one object, refilled each step.
 *
 * Before anything is known it describes a boat that may not move. What is NaN counts as unknown, which is a danger.
 */
public class Situation {
    /** Now, s, on the boat's clock. */
    public var seconds: Double = 0.0

    /** Time since the board last said that it obeys, or, before it is armed, was last understood, s. */
    public var linkAge: Double = Double.POSITIVE_INFINITY

    /** Time since a fix was last used, s; infinite while fixes have not agreed for long enough to be believed. */
    public var fixAge: Double = Double.POSITIVE_INFINITY

    /** Fixes refused in a row. */
    public var jumps: Int = 0

    /** Believed position, east, m. */
    public var x: Double = Double.NaN

    /** Believed position, north, m. */
    public var y: Double = Double.NaN

    /** Standard deviation of the position, m. */
    public var deviation: Double = Double.POSITIVE_INFINITY

    /** How far fixes have lately moved the position beyond what their noise explains, m: it may be off by as much. */
    public var doubt: Double = 0.0

    /** Believed velocity over ground, east, m/s. */
    public var velocityX: Double = 0.0

    /** Believed velocity over ground, north, m/s. */
    public var velocityY: Double = 0.0

    /** Heading, rad, counter-clockwise from east. */
    public var heading: Double = Double.NaN

    /** Boat's battery, V; NaN where it has not been heard of. */
    public var volts: Double = Double.NaN

    /** Charge of the phone that steers, percent; NaN where it does not say. */
    public var phonePercent: Double = Double.NaN

    /** Whether the boat is not under way yet, so that a battery may be charged or changed for another. */
    public var mayCharge: Boolean = false

    /** Whether a person wants the boat to stop. */
    public var operatorStop: Boolean = false

    /** What else a person wants: one of the operator's dangers but the stop; null where nothing. */
    public var operatorWish: Danger? = null

    /** Whether the log can't be written. */
    public var logLost: Boolean = false

    /** Whether what is left of the budget is needed for the way home. */
    public var budgetSpent: Boolean = false

    /** Whether no way home is left on which the boat gets on. */
    public var stranded: Boolean = false

    /** Whether the boat rests because it was held up on every way home that it tried. */
    public var heldUp: Boolean = false

    /** Whether the mission has nothing left to do. */
    public var missionEnded: Boolean = false
}

/** What the gate wants. */
public sealed interface Ruling {
    /** Nothing is wrong. */
    public data object GoOn : Ruling

    /** [danger] is there, and the boat is to do [failsafe]. */
    public data class Fall(val danger: Danger, val failsafe: Failsafe) : Ruling
}

/**
 * Has the last word on every drive, in every state of a mission.
 *
 * [assess] says whether the boat may go on and what to do otherwise; [permit] lets through of a drive what is safe,
 * whoever asks for it. A boat that holds or returns needs the link and its place: without one of them its motors rest,
 * whatever the policy. Near the fence, be it the shore or a keep-out's outline, nearer than it takes to stop, only
 * thrust and turns that lead to the water pass; beyond the margin none does. So a fence wants to lie that distance
 * outside of what is surveyed. A boat that drifts is carried on by the water: that, too, is for the fence to allow.
 *
 * Derivation of the stopping distance: core/docs/SafetyGate.md. Never throws on data. Confined to one thread.
 *
 * @property settings limits and answers.
 * @property fence what to stay within. Retained.
 */
public class SafetyGate(public val settings: SafetySettings, public val fence: Fence) {
    private val boatCharge = LowCharge(settings.lowestVolts, settings.lowFor)
    private val phoneCharge = LowCharge(settings.lowestPhonePercent, settings.lowFor)

    /** Drives refused because they were not finite. */
    public var notFinite: Long = 0
        private set

    /** What to do in [situation]. A battery that was low stays low, unless it [Situation.mayCharge]. */
    public fun assess(situation: Situation): Ruling {
        boatCharge.watch(situation.volts, situation.seconds, situation.mayCharge)
        phoneCharge.watch(situation.phonePercent, situation.seconds, situation.mayCharge)
        val danger = danger(situation) ?: return Ruling.GoOn
        val wanted = settings.answers[danger] ?: Failsafe.STOP
        return Ruling.Fall(danger, if (isBlind(situation)) Failsafe.STOP else wanted)
    }

    /** What of [drive] passes in [situation] under [ruling]. */
    public fun permit(drive: Drive, situation: Situation, ruling: Ruling): Drive {
        if (!drive.forward.isFinite() || !drive.turn.isFinite()) {
            notFinite++
            return Drive.NONE
        }
        val stopped = ruling is Ruling.Fall && ruling.failsafe == Failsafe.STOP
        if (stopped || isBlind(situation)) return Drive.NONE
        val forward = drive.forward.coerceIn(-1.0, 1.0)
        val turn = drive.turn.coerceIn(-1.0, 1.0)
        val distance = fence.distance(situation.x, situation.y)
        // The place is not exact: what counts is where the boat may be.
        if (!(distance - placeError(situation) >= -settings.fenceMargin)) return Drive.NONE
        if (distance > stoppingDistance(situation)) return Drive(forward, turn)
        val pushX = sign(forward) * cos(situation.heading)
        val pushY = sign(forward) * sin(situation.heading)
        val inwards = fence.leadsInwards(situation.x, situation.y, stoppingDistance(situation), pushX, pushY)
        // Way that is left goes where the bow goes: near the fence it is turned inwards only, by the shorter side.
        val cross = cos(situation.heading) * fence.inwardY - sin(situation.heading) * fence.inwardX
        return Drive(if (inwards) forward else 0.0, if (cross < 0) -abs(turn) else abs(turn))
    }

    /**
     * How near the fence the boat may come before thrust outwards ends, m.
     *
     * d = v (t + T) + k σ + b, v the speed over ground, t the reaction, T the stop time, σ the position's standard
     * deviation, b its doubt: the longest way a boat can go whose motors rest, whichever way it turns meanwhile.
     */
    public fun stoppingDistance(situation: Situation): Double = placeError(situation) +
        hypot(situation.velocityX, situation.velocityY) * (settings.reaction + settings.stopTime)

    private fun placeError(situation: Situation) =
        settings.deviations * situation.deviation + situation.doubt

    private fun danger(situation: Situation): Danger? = when {
        situation.operatorStop -> Danger.OPERATOR_STOP
        !(situation.linkAge <= settings.longestSilence) -> Danger.LINK_LOST
        isLost(situation) -> Danger.FIX_STALE
        situation.jumps > settings.mostJumps -> Danger.FIX_JUMPING
        situation.stranded -> Danger.STRANDED
        else -> call(situation).let { if (situation.heldUp && mayWait(it)) Danger.HELD_UP else it }
    }

    /**
     * Whether a boat that is held up on every way home may rest while [danger] waits: not where it is to stop for good,
     * not beyond the fence, where it would drift on, and not where nothing calls it home any more, as one that the
     * water has carried back within the fence: it has a survey to go on with.
     */
    private fun mayWait(danger: Danger?) = danger != null &&
        danger != Danger.FENCE &&
        (settings.answers[danger] ?: Failsafe.STOP) != Failsafe.STOP

    /** What calls a boat that knows where it is and is heard. */
    private fun call(situation: Situation): Danger? = when {
        fence.distance(situation.x, situation.y) < 0 -> Danger.FENCE
        boatCharge.isLow -> Danger.BATTERY_LOW
        phoneCharge.isLow -> Danger.PHONE_LOW
        situation.logLost -> Danger.LOG_LOST
        situation.operatorWish != null -> situation.operatorWish
        situation.missionEnded -> Danger.MISSION_END
        situation.budgetSpent -> Danger.BUDGET_SPENT
        else -> null
    }

    private fun isLost(situation: Situation) = !(situation.fixAge <= settings.oldestFix) ||
        !situation.x.isFinite() ||
        !situation.y.isFinite() ||
        !situation.heading.isFinite() ||
        !situation.deviation.isFinite()

    /** Whether a boat under power would not know what it does. */
    private fun isBlind(situation: Situation) = !(situation.linkAge <= settings.longestSilence) ||
        isLost(situation) ||
        situation.jumps > settings.mostJumps
}
