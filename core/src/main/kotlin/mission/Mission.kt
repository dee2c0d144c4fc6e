package stillwater.mission

import stillwater.control.Danger
import stillwater.control.Failsafe
import stillwater.control.Fence
import stillwater.control.Ruling
import stillwater.control.SafetyGate
import stillwater.control.Situation
import stillwater.estimate.SensorBelief
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.wire.BoardState
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.Message

/**
 * A boat's whole way of working, one [step] after the other: it calls, and computes nothing itself.
 *
 * Link, framer, codec ([BoardPort]); where the boat was when a sample was taken ([PoseHistory]); is it plausible
 * ([PlausibilityGate]); estimator, map; planner, when the last waypoint was reached; follower; safety gate, which has
 * the last word in every state; encoder, link; and one [MissionLog] record a step.
 *
 * The phone hands in its fixes and compass as they come and calls [step] at about 10 Hz, all on one thread: a step
 * farther than half a second from the one before makes the board's watchdog rest the motors. No step throws on data.
 *
 * @property spec the mission.
 * @param link to the board. Retained.
 * @param log where it is written down. Retained.
 * @param recovered what a log tells of this mission, to go on with: idle and disarmed. Its estimator is retained. Null
 *   to begin anew.
 * @param taken takes the readings that go into the map, after they did. Retained.
 * @throws IllegalArgumentException if [recovered] is of another mission.
 */
public class Mission(
    public val spec: MissionSpec,
    link: ByteLink,
    private val log: MissionLog,
    private val recovered: RecoveredMission? = null,
    private val taken: ReadingSink = ReadingSink { },
) {
    init {
        require(recovered == null || recovered.spec == spec) {
            "recovered (${recovered?.spec?.name}) must be of the same mission (${spec.name})"
        }
    }

    private val water = spec.area.water()
    private val mixing = spec.boat.mixing
    private val pose =
        PoseInput(
            LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)),
            spec.boat.topSpeed,
            mixing,
            spec.failsafe.settings().oldestFix,
        )
    private val survey = Survey(
        spec.probe,
        recovered?.estimator ?: spec.estimator.build(spec.grid.grid(), spec.probe),
        object : SurveyListener {
            override fun read(message: Message, verdict: ReadingVerdict, taken: List<Reading>, gate: PlausibilityGate) {
                log.reading(now, message, verdict, taken, gate.held, gate.same, gate.run)
                taken.forEach(this@Mission.taken::take)
            }

            override fun passed(time: BoatTime, place: Position) = log.pass(now, time, place)
        },
    )
    private val port =
        BoardPort(
            link,
            mixing,
            { if (survey.take(it, now)) probe.heard(now) else log.sensor(now, it) },
            lines = log::heard,
        )
    private val probe = ProbeWatch(spec.probe)
    private val use = BudgetUse(spec.budget)
    private val fence = Fence(water.outlines[0], water.outlines.drop(1))
    private val navigator = Navigator(spec, water, fence, pose.track, use, mixing)
    private val gate = SafetyGate(spec.failsafe.settings(), fence)
    private val situation = Situation()
    private var now = BoatTime(Double.NaN)
    private var armedAt = Double.NEGATIVE_INFINITY
    private var disarmedAt = Double.NEGATIVE_INFINITY

    /** When the mission ended, s. */
    private var leftAt = Double.NaN
    private var stopWanted = false
    private var logLost = false
    private var loggedVersion = 0
    private var phonePercent = Double.NaN

    /** What the mission is about. */
    public var state: MissionState = MissionState.Idle
        private set

    /** What a person wants of it once it is armed. */
    public var wish: Wish = Wish.GO_ON
        set(value) {
            if (value != field) {
                log.order(value.word)
                navigator.tryAnew()
            }
            field = value
        }

    /** What was last let through to the motors. */
    public var drive: Drive = Drive.NONE
        private set

    /** What is believed about the water. */
    public val map: FieldMap get() = survey.map

    /** What the estimator believes of its probe; null where it has no model of one. Allocates. */
    public val sensor: SensorBelief? get() = sensorBelief(survey.estimator)

    /**
     * Of the readings that the map took, those so near to a cell's border, or right behind one, that they told of the
     * probe but of no cell; 0 where the estimator takes all places at their word.
     */
    public val unplaced: Long get() = unplacedReadings(survey.estimator)

    /** Where the boat is believed to be, m; null where not known. */
    public val position: Position?
        get() = if (pose.track.isKnown) Position(pose.track.x, pose.track.y) else null

    /** Used of the budget, in its unit. */
    public val used: Double get() = use.used

    /** The board, for what it said of itself and what could not be read. */
    public val board: BoardPort get() = port

    /** Readings that the map had when the mission was taken up again; 0 where it was not. */
    public val readingsBefore: Long get() = recovered?.readings ?: 0

    /** What was left out of the readings since it began, or was taken up again, by reason. */
    public val readings: PlausibilityGate get() = survey.gate

    /** Of these the map has so many from while the boat's place was in doubt: fixes were too old, or did not agree. */
    public val doubtedReadings: Long get() = survey.doubted

    /** Time since the board said anything of the probe, or since the first step, s; NaN before. */
    public val probeSilence: Double get() = probe.silence(now)

    /** Whether a boat under way has not heard its probe for longer than any probe that works is silent. */
    public val isProbeSilent: Boolean get() = isUnderWay(state) && probeSilence > LONGEST_PROBE_SILENCE

    /** Waypoints given up because the boat came no nearer for a minute. */
    public val givenUp: Long get() = navigator.givenUp

    /**
     * Cells that the boat did not get into, and that it went round; those that it came to later are not among them.
     * Allocates.
     */
    public val givenUpCells: List<Int> get() = navigator.givenUpCells.cells

    /** Middles of such cells off the map, as large as its own, m. Allocates. */
    public val givenUpOffMap: List<Position> get() = navigator.givenUpCells.offMap

    /** For how long a boat that was held up on every way home rests before it tries again, s; 0 where it does not. */
    public val restsFor: Double
        get() = if (state == MissionState.Holding(Danger.HELD_UP)) navigator.restsFor(now.seconds) else 0.0

    /** Fixes refused. */
    public val refusedFixes: Long get() = pose.refused

    /** Steps refused because time stood still, went back or was no number. */
    public var refusedSteps: Long = 0
        private set

    /** The waypoints ahead, the one steered for first; for display. Allocates. */
    public fun waypoints(): List<Position> = navigator.ahead()

    /** A person wants the mission to begin; without effect unless it is idle. */
    public fun start() {
        log.order("start")
        if (state == MissionState.Idle) state = MissionState.Preflight(null)
    }

    /** A person wants the boat to stop: motors rest from the next step on, and the mission is over. */
    public fun stop() {
        log.order("stop")
        stopWanted = true
    }

    /** The log can't be written any more: the mission ends as its policy for the end says. */
    public fun logLost() {
        // What is written after a gap is replayed, too.
        if (!logLost) log.order("log-lost")
        logLost = true
    }

    /**
     * The phone that steers says its charge, [percent], NaN where it does not know: when that is low, the policy says.
     */
    public fun phoneCharge(percent: Double) {
        // Told as often as the phone likes, written down when it changes.
        if (percent.equals(phonePercent)) return
        log.phone(percent)
        phonePercent = percent
    }

    /** The phone's fix of [place] at [time]. */
    public fun fix(time: BoatTime, place: LatLon) {
        log.fix(time, place)
        pose.fix(time, place)
    }

    /** The phone's [heading] at [time], rad, counter-clockwise from east, and [yawRate], rad/s, NaN where unknown. */
    public fun compass(time: BoatTime, heading: Double, yawRate: Double) {
        log.compass(time, heading, yawRate)
        pose.compass(time, heading, yawRate)
    }

    /** Does all that is due at [time], on the boat's clock. Answers the state afterwards. */
    public fun step(time: BoatTime): MissionState {
        if (!time.seconds.isFinite() || time.seconds <= now.seconds) {
            refusedSteps++
            return state
        }
        val dt = if (now.seconds.isNaN()) begin(time) else time - now
        now = time
        pose.advance(time, dt, drive)
        if (pose.track.isKnown) survey.pose(time, pose.track.x, pose.track.y, pose.track.deviation)
        survey.isDoubted = pose.isDoubted
        port.hear(time)
        val ruling = assess()
        val before = state
        // A board says that it is active before its motors are armed.
        val board = if (port.isRunning) BoardState.ACTIVE else port.state.takeIf { port.isDisarmed }
        state = MissionPhases.next(state, PhaseInput(ruling, board, navigator.isHome, spec.failsafe.rearms))
        if (isUnderWay(state)) use.advance(dt, pose.track.groundSpeed)
        drive = gate.permit(wanted(ruling), situation, ruling)
        if (probe.isMissed(now)) drive = Drive.NONE
        command(before)
        log.step(record(time))
        return state
    }

    private fun record(time: BoatTime): StepRecord {
        val isNew = navigator.givenUpVersion != loggedVersion
        loggedVersion = navigator.givenUpVersion
        val cells = if (isNew) navigator.givenUpCells else null
        val rest = navigator.restAt(now.seconds)
        return StepRecord(time, state, position, pose.heading, drive, use.used, survey.gate.leftOut, cells, rest)
    }

    private fun begin(time: BoatTime): Double {
        probe.begin(time)
        // Whoever is there is listened to before anything is said.
        disarmedAt = time.seconds - (SELDOM - LISTENING)
        recovered?.let {
            survey.resume(it, time)
            use.resume(it.used)
            navigator.resume(it.givenUp, it.rest, time.seconds)
        }
        return 0.0
    }

    private fun assess(): Ruling {
        pose.describe(situation)
        situation.seconds = now.seconds
        // Under way only motor lines tell that the boat obeys; a board that is not armed has none.
        val isArmed = state !is MissionState.Preflight && state !is MissionState.Idle
        situation.linkAge = if (isArmed) port.motorSilence(now) else port.silence(now)
        // What is low stays low: a battery that is not connected yet does not count.
        val isIdle = state == MissionState.Idle
        situation.volts = if (isIdle) Double.NaN else port.volts
        situation.phonePercent = if (isIdle) Double.NaN else phonePercent
        situation.mayCharge = state is MissionState.Preflight
        situation.operatorStop = stopWanted
        situation.operatorWish = wish.danger
        situation.logLost = logLost
        situation.budgetSpent = navigator.isHomeBound
        situation.missionEnded = navigator.isOver
        situation.stranded = navigator.isStranded
        situation.heldUp = isArmed && navigator.restsFor(now.seconds) > 0
        return gate.assess(situation)
    }

    /** What the mission would do if the gate let it. */
    private fun wanted(ruling: Ruling): Drive {
        when (state) {
            MissionState.Surveying -> navigator.survey(now.seconds, survey.map, survey.lastValue)
            is MissionState.Returning -> navigator.goHome(now.seconds, isDriven = drive != Drive.NONE)
            is MissionState.Holding ->
                if (ruling is Ruling.Fall && ruling.failsafe == Failsafe.HOLD) navigator.hold() else navigator.rest()
            else -> navigator.rest()
        }
        return navigator.steer(pose.heading, pose.yawRate)
    }

    private fun command(before: MissionState) {
        when (state) {
            MissionState.Idle, is MissionState.Preflight -> leaveDisarmed()
            is MissionState.Stopped -> {
                if (before !is MissionState.Stopped) {
                    leftAt = now.seconds
                    port.tell(now, Drive.NONE)
                    // What it said of itself before it was told so does not count.
                    port.order(Command.Disarm)
                }
                leaveDisarmed()
            }
            MissionState.Arming -> arm(before)
            // However long the silence is when it is noticed, rest is said once. After that any line would keep the
            // watchdog quiet, a question too; the board speaks unasked when it is heard again.
            else -> if (state != before || !isDeaf()) {
                port.tell(now, drive, isCalm = true, staysArmed = true)
                port.askState(now, if (port.sent.isAtRest) BoardPort.KEEPING else BoardPort.PATIENCE)
            }
        }
        setProbeUp()
    }

    /**
     * A process that died may have left the board armed, any question asked of it keeps its watchdog quiet, and what it
     * answers may not arrive: so it is told in every step until it says that it is disarmed, and then once a second. A
     * board of the master branch cannot be disarmed, and runs for as long as it is told anything: where it says that it
     * runs it is told to rest. Else it is not: a rest can be spoilt on the way and become a drive, which a board that
     * arms keeps. One that is not heard is best left to its watchdog, which a word now and then does not keep quiet.
     */
    private fun leaveDisarmed() {
        val isLeftLately = state is MissionState.Stopped && now.seconds - leftAt <= BoardPort.RESTING
        if (!isLeftLately && port.silence(now) > BoardPort.RESTING) {
            if (now.seconds - disarmedAt < SELDOM) return
            disarmedAt = now.seconds
            port.order(Command.Disarm)
            return port.askState(now)
        }
        if (isLeftLately || port.saysItRuns(now)) port.tell(now, Drive.NONE, isCalm = true)
        val isTold = port.isDisarmed || port.armsItself
        if (!isTold || now.seconds - disarmedAt >= BoardPort.PATIENCE) {
            disarmedAt = now.seconds
            port.order(Command.Disarm)
        }
        port.askState(now, BoardPort.KEEPING)
    }

    /**
     * Rest is said before the board is told to arm, for what it was told before it goes on: v4.2.0 does not forget a
     * drive when it arms. Then questions keep its watchdog quiet, which cannot be spoilt on the way and become a drive
     * as rests can. The slowest pair of motor controllers takes 36 s; a board that is armed already does not begin anew
     * (v4.2.0), but one that says that it is not was not reached.
     */
    private fun arm(before: MissionState) {
        val since = now.seconds - armedAt
        val isMissed = port.isDisarmed && since >= BoardPort.PATIENCE
        if (before != MissionState.Arming || isMissed || since >= LONGEST_ARMING) {
            armedAt = now.seconds
            port.rest(now)
            port.order(Command.Arm)
        } else if (port.silence(now) <= LONGEST_QUIET) {
            if (port.silence(now) <= BoardPort.RESTING) port.tell(now, Drive.NONE, isCalm = true)
            port.askState(now, BoardPort.KEEPING)
        }
    }

    /** Only a boat at rest is to lose a reading or two; one under way is halted for it. */
    private fun setProbeUp() {
        if (state == MissionState.Idle || state is MissionState.Stopped || port.silence(now) > BoardPort.RESTING) return
        // Who waits to be armed may wait for long: what is left of the words is for a probe that is plugged in later.
        if (state is MissionState.Preflight && probe.isTold) return
        val isAtRest = !port.isRunning || (port.sent.isAtRest && port.isRestKept(now))
        if (!isAtRest || !probe.isDue(now)) return
        probe.told(now)
        probe.setUp?.let(port::order)
    }

    /** A boat that waits to be sent off has not begun to use its budget; one that rests for hours uses none. */
    private fun isUnderWay(state: MissionState) = when (state) {
        MissionState.Surveying, is MissionState.Returning -> true
        is MissionState.Holding -> state.danger != Danger.OPERATOR_WAIT && state.danger != Danger.HELD_UP
        else -> false
    }

    /** Rest was said; what is said on to a board that is not heard can only be spoilt on the way and become a drive. */
    private fun isDeaf() = state == MissionState.Holding(Danger.LINK_LOST) && port.silence(now) > BoardPort.RESTING

    private companion object {
        const val LONGEST_ARMING = 40.0

        /** A board that is not heard for so long while it arms is left to its watchdog, s: six answers were lost. */
        const val LONGEST_QUIET = 2.0

        /** Time between words to a board that is not heard, s: more than the longest watchdog, 3 s. */
        const val SELDOM = 5.0

        /** In which a board that a process before left running comes to rest by itself where it is not heard, s. */
        const val LISTENING = 1.0

        /** Ten times what the slowest firmware takes for a reading, s. */
        const val LONGEST_PROBE_SILENCE = 30.0
    }
}
