package stillwater.closedloop

import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionState
import stillwater.mission.RecoveredMission
import stillwater.model.BoatTime
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.virtual.VirtualBoat
import kotlin.random.Random

/** A mission, its boat and its faults in virtual time, from [case] alone, with an [Observer] beside it. */
internal class CampaignRun(private val case: CampaignCase, private val kinds: Set<FaultKind>) {
    private val random = Random(case.seed * 31 + 7)
    private val spec = case.spec
    val boat = VirtualBoat(
        case.boat,
        case.field,
        LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)),
        case.seed,
    )
    private val link = FaultyLink(boat.phone, Random(case.seed * 31 + 8))
    private val faults = Faults(kinds, boat, link, Random(case.seed * 31 + 9))
    private val water = spec.area.water()
    private val observer = Observer(boat, water, MARGIN, case.watchdog + SLACK)
    private val text = StringBuilder()
    private val lineSteps = ArrayList<Int>()

    /** Length of the log at the end of each step: what was on its way to the disk a second ago. */
    private val lengths = ArrayList<Int>()

    /** Steps whose lines of the log may be gone with a process. */
    private val goneSteps = HashSet<Int>()
    private var step = 0
    private var isMoored = true

    /** By which the boat's clock is before the virtual time, s. */
    private var clock = if (FaultKind.CLOCK_WRAP in kinds) WRAP - random.nextDouble(20.0, 200.0) else 0.0
    private var mission = begin(null)
    private var startAt = random.nextDouble(2.0, 4.0)
    private var deadUntil = -1.0

    /** What happens at the end of each step besides; for those who test the observer. */
    var meanwhile: () -> Unit = {}

    /** Whether the run ends where the process is dead, a while after it began. */
    var endsDead = false

    private val verdicts = Verdicts()

    /** Lives through the mission, and judges it. */
    fun run(): RunResult {
        var exception: Throwable? = null
        try {
            var over = 0
            while (over < AFTERWARDS && step < LONGEST && !(endsDead && deadUntil > DEAD_AFTER)) {
                tick()
                if (mission.state is MissionState.Stopped && deadUntil < 0) over++
            }
            // What a process that is dead at the end had not yet written is gone with it: its heir is judged.
            if (deadUntil >= 0) restart()
            judge()
        } catch (@Suppress("TooGenericExceptionCaught") e: Exception) {
            exception = e
        }
        if (FaultKind.CLOCK_WRAP in kinds) faults.occurred[FaultKind.CLOCK_WRAP.ordinal] += clockPassed()
        return RunResult(case, kinds, faults.occurred, observer, verdicts, mission.state, exception, faults.wrongStamps)
    }

    private fun clockPassed() = if (boat.time.seconds + clock > WRAP) 1 else 0

    private fun tick() {
        step++
        link.step = step
        drift()
        repeat(TICKS) {
            boat.advance(VirtualBoat.TICK)
            observer.look(VirtualBoat.TICK, faults.isLinked && deadUntil < 0)
        }
        faults.strike(boat.time.seconds)
        process()
        meanwhile()
        lengths.add(text.length)
    }

    /** A person holds the boat until it goes for the first time. */
    private fun drift() {
        if (!boat.board.actuation.isAtRest) isMoored = false
        if (isMoored) return
        boat.dynamics.currentX = case.currentX(boat.time.seconds)
        boat.dynamics.currentY = case.currentY(boat.time.seconds)
        boat.dynamics.windX = case.windX
        boat.dynamics.windY = case.windY
    }

    private fun process() {
        val now = boat.time.seconds
        if (deadUntil >= 0) {
            boat.takeFix()
            if (now < deadUntil) return
            deadUntil = -1.0
            restart()
        }
        if (FaultKind.PROCESS_KILL in kinds && now > QUIET && random.nextDouble() < STEP / KILL_EVERY) {
            die(now)
            return
        }
        val time = BoatTime(now + clock)
        boat.takeFix()?.let { fix ->
            val told = BoatTime(faults.time(fix.time.seconds + clock))
            faults.fix(fix.place)?.let { mission.fix(told, it) }
        }
        mission.compass(time, faults.number(boat.heading()), faults.number(boat.yawRate))
        if (now >= startAt) mission.start()
        mission.step(time)
    }

    /** The disk has the log up to any byte of the last second. */
    private fun die(now: Double) {
        faults.occurred[FaultKind.PROCESS_KILL.ordinal]++
        val flushed = lengths.getOrElse(lengths.size - FLUSHED) { 0 }
        // Its first line is flushed before anybody starts the mission.
        val kept = random.nextInt(maxOf(flushed, text.indexOf("\n") + 1), text.length + 1)
        for (gone in step - FLUSHED..step) goneSteps.add(gone)
        text.setLength(kept)
        lengths.replaceAll { minOf(it, kept) }
        val lines = text.count { it == '\n' } + if (text.endsWith('\n')) 0 else 1
        while (lineSteps.size > lines) lineSteps.removeAt(lineSteps.size - 1)
        deadUntil = now + random.nextDouble(0.2, 20.0)
        mission.state.let { if (it is MissionState.Stopped) deadUntil = now + 0.2 }
    }

    private fun restart() {
        val recovery = MissionRecovery()
        text.split('\n').forEach(recovery::line)
        val found = recovery.recovered()
        verdicts.recoveries++
        val account = LogAccount(text.toString())
        if (found == null || found.readings != account.readings.toLong()) verdicts.lostInRecovery++
        // Whoever appends to a file that was cut begins on a new line.
        if (!text.endsWith('\n')) text.append('\n')
        link.flush()
        // Opening the port resets many boards; and a phone that was rebooted begins its clock anew.
        if (random.nextBoolean()) boat.board.reset()
        if (random.nextInt(3) == 0) clock = -boat.time.seconds
        startAt = boat.time.seconds + random.nextDouble(2.0, 8.0)
        mission = begin(found)
    }

    private fun begin(recovered: RecoveredMission?): Mission {
        val log = MissionLog(::write, LogStart(0, "campaign"), spec)
        return Mission(spec, link, log, recovered)
    }

    private fun write(line: String) {
        text.append(line).append('\n')
        lineSteps.add(step)
    }

    private fun judge() {
        // What follows the last line's end is no line.
        val account = LogAccount(text.toString(), lineSteps + step)
        verdicts.readings = account.readings
        // What the map holds is what the log says, to the last bit, whichever process took it.
        verdicts.mapsApart = LogAccount.differences(account.estimator().map, mission.map)
        judgeLines(account)
        judgeBounds(account)
    }

    /** Each of the probe's lines that arrived whole while somebody listened is in the log, in order. */
    private fun judgeLines(account: LogAccount) {
        var next = 0
        for (line in link.probeLines) {
            val value = line.said.toDoubleOrNull() ?: continue
            if (!line.isWhole || !value.isFinite() || line.step in goneSteps) continue
            var at = next
            while (at < account.said.size && account.said[at] != value) at++
            verdicts.delivered++
            if (at == account.said.size) verdicts.unlogged++ else next = at + 1
        }
    }

    /** The bounds without the readings that a bad line made. */
    private fun judgeBounds(account: LogAccount) {
        val bad = badEvents(account)
        verdicts.badTaken = bad.map { account.events[it].value to sentAbout(account.eventSteps[it]) }
        if (bad.isEmpty()) return
        val without = account.estimator { it !in bad }.map
        for (cell in 0 until without.grid.size) {
            val truth = case.truth(cell)
            val holds = truth in mission.map.lower(cell) - TOLERANCE..mission.map.upper(cell) + TOLERANCE
            val held = truth in without.lower(cell) - TOLERANCE..without.upper(cell) + TOLERANCE
            if (held && !holds) verdicts.spoiltBounds++
            if (!held && holds) verdicts.mendedBounds++
        }
    }

    /** Numbers of the events whose value is not what the board had sent, at the step or a little before. */
    private fun badEvents(account: LogAccount): Set<Int> {
        val sent = link.probeLines
        var from = 0
        return account.events.indices.filterTo(HashSet()) { event ->
            val written = account.eventSteps[event]
            while (from < sent.size && sent[from].step < written - NEARBY) from++
            val near = (from until sent.size).takeWhile { sent[it].step <= written }
            !account.events[event].value.isNaN() && near.none { sent[it].truth == account.events[event].value }
        }
    }

    /** What the probe last said until [step]; NaN before. */
    private fun sentAbout(step: Int) = link.probeLines.lastOrNull { it.step <= step }?.truth ?: Double.NaN

    private companion object {
        const val STEP = 0.1
        const val TICKS = 5
        const val FLUSHED = 10
        const val LONGEST = 7000
        const val AFTERWARDS = 30
        const val DEAD_AFTER = 60.0
        const val QUIET = 5.0
        const val KILL_EVERY = 80.0
        const val MARGIN = 5.0

        /** The bar is 0.6 s with a watchdog of 0.5 s. */
        const val SLACK = 0.1 + 1e-6

        /** Steps between the board's line and the log's. */
        const val NEARBY = 3

        /** Three deviations of the probe's noise. */
        const val TOLERANCE = 0.06
        val WRAP = (1L shl 32) / 1000.0
    }
}

/** What the observer and the log tell of a run. */
internal class Verdicts {
    var readings = 0
    var recoveries = 0
    var lostInRecovery = 0
    var mapsApart = 0
    var delivered = 0
    var unlogged = 0

    /** Values that the map took and that the board had not sent, each with what it had sent last. */
    var badTaken = emptyList<Pair<Double, Double>>()

    /** Cells whose bounds hold without what bad lines made and not with it, and the other way round. */
    var spoiltBounds = 0
    var mendedBounds = 0
}

/** One run of the campaign. */
internal class RunResult(
    val case: CampaignCase,
    val kinds: Set<FaultKind>,
    val occurred: IntArray,
    val observer: Observer,
    val verdicts: Verdicts,
    val end: MissionState,
    val exception: Throwable?,
    val wrongStamps: Int,
) {
    val isSlowBoard get() = case.watchdog > 1
}
