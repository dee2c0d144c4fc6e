package stillwater.app.service

import android.Manifest
import android.content.Context
import android.os.Handler
import android.os.SystemClock
import stillwater.app.R
import stillwater.app.demo.DemoBoat
import stillwater.app.link.HeldLink
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkMaker
import stillwater.app.link.LinkState
import stillwater.app.mission.BoatAtHand
import stillwater.app.mission.MissionControl
import stillwater.app.pose.PhonePose
import stillwater.app.pose.Pose
import stillwater.app.pose.PoseProblem
import stillwater.mission.MissionSpec
import stillwater.mission.ProbeSpec
import stillwater.mission.Wish
import stillwater.mission.setUp
import stillwater.model.Actuation
import stillwater.wire.BoardState
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder

/**
 * What the service does ten times a second: pose and bytes to the mission, its commands to the board, all of it to the
 * screens. Confined to the boat's thread but for [snapshot].
 *
 * @param handler of the boat's thread. Retained.
 * @param missions what the boat is to do. Retained.
 * @param onChange called where what the notification says has changed.
 */
internal class BoatLoop(
    private val context: Context,
    private val handler: Handler,
    private val missions: MissionControl,
    private val onChange: () -> Unit,
) {
    private val preflight = Preflight(context)
    private val held = HeldLink()
    private val phone = PhonePose(context)
    private val gaps = GapDetector()
    private val area = AreaDistance()
    private val watchdog = Watchdog()

    @Volatile private var demo: DemoBoat? = null
    private var due = 0L
    private var ticks = 0L
    private var askedAt = Double.NEGATIVE_INFINITY
    private var heardAt = Double.NEGATIVE_INFINITY
    private var messages = 0L
    private var answer: Answer? = null
    private var checks = emptyList<PreflightItem>()

    /** How many connections of the link have begun with a board that was told to stand still. */
    private var disarmed = 0L

    /** Whether the board was asked since the link came about. */
    private var isAnswerDue = false
    private var named: ProbeSpec? = null
    private var namedTimes = 0
    private var namedAt = Double.NEGATIVE_INFINITY

    /** What the service is about, to be shown; any thread. */
    @Volatile var activity = BoatActivity.IDLE

    /** Why the service may not run; any thread. */
    @Volatile var refusal: String? = null

    /** Whether Android gives no position before a window is in sight; any thread. */
    @Volatile var isWithoutPlace = false

    /** Whether a screen is in sight: without a link too, an area can be drawn by walking along it. */
    var isLookedAt = false

    /** Whether the link is about to be let go of: nothing begins over it. */
    var isGivingUp = false

    /** Whether [phone] listens though no link is held. */
    private var listens = false

    /** What the screens show; any thread. */
    @Volatile var snapshot = BoatSnapshot()
        private set

    /** The thread that looks after this one. */
    internal val watchdogLooper get() = watchdog.looper

    /** Readings that the demo's probe has sent, by its own count; null where there is no demo. */
    internal val demoReadings: Long? get() = demo?.readings

    private val pose: Pose get() = demo?.pose ?: phone

    /** Begins. */
    fun start() {
        missions.recover {
            anchorDemo()
            look(now())
        }
        watchdog.start()
        due = SystemClock.uptimeMillis()
        handler.post(tick)
    }

    /** Ends, as the process does: nothing is closed that a later one may go on with. */
    fun leave() {
        handler.removeCallbacks(tick)
        // Armed, too, and at rest: nobody is left to say the next word.
        if (missions.isUnderWay) standStill()
        missions.leave()
        watchdog.stop()
        held.hold(null)
        pose.stop()
    }

    /** Holds the link of [choice] in place of the one before. */
    fun hold(choice: LinkChoice, links: LinkMaker) {
        pose.stop()
        phone.stop()
        listens = false
        if (missions.isMoving) held.write(REST)
        when (choice) {
            is LinkChoice.Demo -> holdDemo()
            is LinkChoice.Board -> {
                demo = null
                held.hold(links.make(context, choice))
            }
        }
        begun()
    }

    /** Whether [choice] is a virtual boat in place of a real one, or the other way round, while a mission is under way. */
    fun isOtherWorld(choice: LinkChoice): Boolean =
        missions.isUnderWay && held.link != null && (choice is LinkChoice.Demo) != (demo != null)

    private fun holdDemo() {
        val fresh = DemoBoat(context.getString(R.string.demo), missions.spec)
        demo = fresh
        held.hold(fresh.link)
    }

    /** Goes on with the mission whose log, cut off, is [name]; the demo's boat is put at its home. */
    fun goOnWith(name: String) =
        command {
            goOnWith(name) { refused ->
                answer = refused
                if (refused == null) anchorDemo()
                look(now())
            }
        }

    /** Puts the demo's boat at the home of the mission that is loaded now. */
    private fun anchorDemo() {
        if (demo == null || missions.isUnderWay) return
        holdDemo()
        begun()
    }

    private fun begun() {
        isGivingUp = false
        disarmed = 0
        messages = 0
        heardAt = Double.NEGATIVE_INFINITY
        pose.start(handler)
        look(now())
    }

    /** Lets go of the link, and ends the mission. */
    fun letGo() {
        isGivingUp = false
        missions.end()
        held.hold(null)
        pose.stop()
        demo = null
        gaps.rest()
        watchdog.feed(null)
        look(now())
    }

    /** A person says stop: answers whether a mission was under way, which goes on being told to stand still. */
    fun stop(): Boolean {
        val wasUnderWay = missions.isUnderWay
        missions.stop()
        standStill()
        return wasUnderWay
    }

    /** Does what a screen asks for, and keeps what [command] answers. */
    fun command(command: MissionControl.() -> Answer?) {
        answer = missions.command()
        look(now())
    }

    /** Loads [json]; the demo's boat is put at its home. */
    fun load(json: String) =
        command {
            val refused = load(json)
            if (refused == null) anchorDemo()
            refused
        }

    /** Arms, with [wish] for what comes after. */
    fun begin(wish: Wish) {
        if (isGivingUp) return command { Answer(Answer.Reason.GIVEN_UP) }
        check(now())
        val boat = held.link?.let { BoatAtHand(held, it.name, isVirtual = demo != null) }
        command { begin(boat, checks.all { it.ready }, wish) }
    }

    private val tick: Runnable =
        object : Runnable {
            override fun run() {
                work(now())
                // Not from when it ran, or ten times a second would be nine; nor all at once what was missed.
                val period = if (held.link == null) IDLE_MILLIS else STEP_MILLIS
                due = maxOf(due + period, SystemClock.uptimeMillis())
                handler.postAtTime(this, due)
            }
        }

    private fun work(now: Double) {
        if (held.link != null) {
            gaps.tick(now)
            demo?.advance(now)
            greet()
            if (missions.isUnderWay) missions.step(now, pose) else overhear(now)
            watchdog.feed(held.takeIf { missions.isMoving })
            if (held.ears.messages != messages) heardAt = now
            messages = held.ears.messages
        } else {
            listen()
        }
        if (ticks++ % LOOK_TICKS == 0L || held.link == null) {
            if (held.link != null) listenAgain()
            missions.closeAgain()
            look(now)
        }
        if (ticks % FLUSH_TICKS == 0L) missions.flush()
    }

    /** Where the phone is, while someone looks; a permission that is given meanwhile counts from then on. */
    private fun listen() {
        if (isLookedAt && !listens) {
            phone.start(handler)
            listens = phone.problem != PoseProblem.NOT_PERMITTED
            if (!listens) phone.stop()
        } else if (!isLookedAt && listens) {
            phone.stop()
            listens = false
        }
    }

    /** What was kept back when it was first asked for is asked for again. */
    fun listenAfresh() {
        if (held.link == null) return
        pose.stop()
        pose.start(handler)
    }

    /** With a link, too, a permission that is given meanwhile counts from then on. */
    private fun listenAgain() {
        if (pose.problem != PoseProblem.NOT_PERMITTED) return
        if (Manifest.permission.ACCESS_FINE_LOCATION in Preflight.missingPermissions(context)) return
        listenAfresh()
    }

    /** Whatever a board was told before this connection, by a process that died perhaps: it is over. */
    private fun greet() {
        val connects = held.link?.health?.connects ?: 0
        if (connects == disarmed) return
        if (!missions.isUnderWay) standStill()
        disarmed = connects
        isAnswerDue = false
        named = null
    }

    /** No mission listens. A question a second keeps a link alive that is cut when idle; no board is to be armed. */
    private fun overhear(now: Double) {
        held.listen()
        if (held.link?.health?.state != LinkState.CONNECTED || now - askedAt < QUESTION_SECONDS) return
        askedAt = now
        held.write(PlatypusEncoder.encode(Command.AskState))
        val state = held.ears.report.state
        // A question alone would keep the watchdog of a board quiet that runs and is not heard.
        val isUnheard = state == null && isAnswerDue
        if (isUnheard || state == BoardState.ACTIVE) standStill()
        isAnswerDue = true
        if (state != null) nameProbe(now)
    }

    /** Firmware v4.2.0 reads no port that it was not told of: a silent probe is named to it, so that the checklist knows. */
    private fun nameProbe(now: Double) {
        val probe = missions.spec?.takeUnless(::isHeard)?.probe ?: return
        if (probe != named) namedTimes = 0
        if (namedTimes >= MOST_NAMINGS || now - namedAt < NAMING_SECONDS) return
        named = probe
        namedTimes++
        namedAt = now
        probe.setUp?.let { held.write(PlatypusEncoder.encode(it)) }
    }

    private fun standStill() {
        held.write(REST)
        held.write(PlatypusEncoder.encode(Command.Disarm))
    }

    private fun check(now: Double) {
        val fix = pose.fix
        checks =
            preflight.look(
                BoatAtRest(
                    hasLink = held.link != null,
                    link = held.link?.health ?: LinkHealth(),
                    boardSilence = now - heardAt,
                    volts = held.ears.report.batteryVolts,
                    lowestVolts = missions.lowestVolts,
                    pose = pose.problem,
                    fixAgeSeconds = age(fix?.elapsedNanos),
                    accuracyMetres = fix?.accuracyMetres,
                    hasHeading = age(pose.heading?.elapsedNanos)?.let { it <= OLDEST_HEADING } == true,
                    isVirtual = demo != null,
                    metresToArea = missions.spec?.let { spec -> fix?.let { area.metresTo(spec, it.place) } },
                    hasProbe = missions.spec?.let(::isHeard) != false,
                    hasMission = missions.spec != null,
                ),
            )
    }

    private fun isHeard(spec: MissionSpec): Boolean =
        held.ears.report.probes.any {
            it.quantity == spec.probe.quantity && (spec.probe.port == null || spec.probe.port == it.port)
        }

    private fun look(now: Double) {
        check(now)
        missions.phoneCharge(preflight.phoneBatteryPercent)
        val link = held.link
        val fix = pose.fix
        val before = snapshot
        snapshot =
            BoatSnapshot(
                activity = activity,
                linkName = link?.name,
                isDemo = demo != null,
                link = link?.health ?: LinkHealth(),
                board = held.ears.report,
                refusal = refusal,
                isWithoutPlace = isWithoutPlace,
                fix = fix,
                fixAgeSeconds = age(fix?.elapsedNanos),
                fixes = missions.fixes(pose),
                headingDeg = pose.heading?.degrees,
                phoneBatteryPercent = preflight.phoneBatteryPercent,
                gaps = gaps.gaps,
                preflight = checks,
                mission = missions.report(),
                answer = answer,
                past = missions.past,
            )
        if (link != null && told(before) != told(snapshot)) onChange()
    }

    /** What the notification says. */
    private fun told(shot: BoatSnapshot) =
        listOf(
            shot.link.state,
            shot.linkName,
            shot.mission?.state,
            shot.mission?.log?.problem,
            shot.mission?.probeSilence != null,
            shot.isWithoutPlace,
        )

    private fun age(elapsedNanos: Long?): Double? = elapsedNanos?.let { now() - it * SECONDS_PER_NANO }

    /** The boat's clock: goes on while the phone sleeps, and is the one that fixes are stamped with. */
    private fun now(): Double = SystemClock.elapsedRealtimeNanos() * SECONDS_PER_NANO

    private companion object {
        val REST: ByteArray = PlatypusEncoder.encode(Command.Move(Actuation.Differential(0.0, 0.0)))
        const val STEP_MILLIS = 100L
        const val IDLE_MILLIS = 500L
        const val LOOK_TICKS = 5L

        /** A second: no more of a log is lost with the process. */
        const val FLUSH_TICKS = 10L
        const val MOST_NAMINGS = 3

        /** A probe that was named speaks within, s. */
        const val NAMING_SECONDS = 10.0
        const val QUESTION_SECONDS = 1.0

        /** A sensor speaks fifty times a second, s. */
        const val OLDEST_HEADING = 1.0
        const val SECONDS_PER_NANO = 1e-9
    }
}
