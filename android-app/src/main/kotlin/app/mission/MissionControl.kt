package stillwater.app.mission

import stillwater.app.pose.Pose
import stillwater.app.service.Answer
import stillwater.app.service.FixCounts
import stillwater.mission.GivenUp
import stillwater.mission.MissionDraft
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.mission.Wish
import stillwater.wire.ByteLink

/** Runs what may wait for the disk on a thread of its own, and what comes of it on the boat's. */
internal interface Disk {
    /** Runs [work] on the disk's thread, one after the other. */
    fun run(work: () -> Unit)

    /** Runs [work] on the boat's thread. */
    fun answer(work: () -> Unit)
}

/**
 * The boat that a mission is to be run with.
 *
 * @property link to its board.
 * @property name of the link.
 * @property isVirtual whether boat and water are the demo's.
 */
internal class BoatAtHand(val link: ByteLink, val name: String, val isVirtual: Boolean)

/** Keeps a text beyond the process. */
internal interface Keeper {
    /** What was kept; null where nothing was. */
    var mission: String?
}

/**
 * Which mission is loaded, and what became of it: loaded, under way, over. Commands answer why they were not followed,
 * or null. Confined to the boat's thread.
 *
 * @param folder of the logs. Retained.
 * @param disk where files are worked on. Retained.
 * @param keeper keeps the mission that is loaded beyond the process. Retained.
 * @param epochMillis the wall clock, Unix time, ms.
 */
internal class MissionControl(
    private val folder: LogFolder,
    private val disk: Disk,
    private val keeper: Keeper,
    private val epochMillis: () -> Long,
) {
    /** The mission that is loaded; null where none is. */
    var spec: MissionSpec? = null
        private set

    /** Missions on the disk, newest first; null before they were looked for. */
    var past: List<PastMission>? = null
        private set

    private var recovered: RecoveredRun? = null
    private var run: MissionRun? = null
    private var last: MissionReport? = null
    private var flushing = false
    private var unclosed: Pair<LogFile, MissionReport>? = null

    /** Whether a mission was started and is not over: stepped, and its board maybe armed. */
    val isUnderWay: Boolean get() = run != null

    /**
     * Below which voltage the boat's battery is low, V; 0 where nobody watches it; null where the mission does not say.
     */
    val lowestVolts: Double?
        get() =
            // What was begun before missions had to say so can be brought to its end.
            spec?.failsafe?.lowestVolts ?: 0.0.takeIf { recovered != null || isUnderWay }

    /** Whether the motors were last told to do something. */
    val isMoving: Boolean get() = run?.isMoving == true

    /** Takes the mission in [json] in place of the one that is loaded. */
    fun load(json: String): Answer? {
        if (isUnderWay) return Answer(Answer.Reason.UNDER_WAY)
        val read =
            try {
                MissionSpec.fromJson(json).also(MissionDraft::requireDrawable)
            } catch (error: IllegalArgumentException) {
                return Answer(Answer.Reason.NOT_A_MISSION, error.message)
            }
        recovered = null
        spec = read
        keeper.mission = json
        last = null
        return null
    }

    /**
     * Has what a process left behind: the mission of the log that was cut off last, unless another was loaded after
     * that.
     * [then] comes after.
     */
    fun recover(then: () -> Unit) {
        disk.run {
            val found = folder.recover()
            val all = folder.past()
            disk.answer {
                past = all
                if (spec == null) {
                    val kept = kept()
                    if (found != null && (kept == null || kept == found.mission.spec)) takeUp(found) else spec = kept
                }
                then()
            }
        }
    }

    /**
     * Loads the mission whose log, cut off, is [name], to go on with; the one that is loaded stays on the disk as it
     * is.
     * [then] hears why not, or null.
     */
    fun goOnWith(name: String, then: (Answer?) -> Unit): Answer? {
        if (isUnderWay) return Answer(Answer.Reason.UNDER_WAY)
        disk.run {
            val found = folder.recover(name)
            disk.answer {
                // A mission may have been started meanwhile.
                val answer =
                    when {
                        isUnderWay -> Answer(Answer.Reason.UNDER_WAY)
                        found == null -> Answer(Answer.Reason.NOT_READABLE)
                        else -> null
                    }
                if (found != null && answer == null) takeUp(found)
                then(answer)
            }
        }
        return null
    }

    private fun takeUp(found: RecoveredRun) {
        recovered = found
        spec = found.mission.spec
        last = null
    }

    private fun kept(): MissionSpec? =
        keeper.mission?.let {
            try {
                MissionSpec.fromJson(it)
            } catch (_: IllegalArgumentException) {
                // Kept by another version of the app: the person loads it again and is told what is wrong.
                null
            }
        }

    /** Starts the mission with [boat], with [wish], where [isReady]; tells one that was started of [wish]. */
    fun begin(boat: BoatAtHand?, isReady: Boolean, wish: Wish): Answer? {
        val spec = this.spec ?: return Answer(Answer.Reason.NO_MISSION)
        run?.let { return wish(it, wish) }
        if (last?.isOver == true) return Answer(Answer.Reason.OVER)
        if (boat == null) return Answer(Answer.Reason.NOT_READY)
        otherWorld(boat)?.let { return it }
        if (!isReady) return Answer(Answer.Reason.NOT_READY)
        val now = epochMillis()
        val name = if (boat.isVirtual) VIRTUAL + spec.name else spec.name
        val log = recovered?.let { folder.goOn(it.name) } ?: folder.begin(name, now)
        // After the process died it is this one that comes back, whichever was loaded before.
        keeper.mission = spec.toJson()
        run = MissionRun(spec, boat, log, recovered, now).also {
            it.wish = wish
            it.start()
        }
        recovered = null
        return null
    }

    /** What stands against going on with what another kind of boat began: half of that map would be measured. */
    private fun otherWorld(boat: BoatAtHand): Answer? {
        val wasVirtual = recovered?.mission?.isVirtual
        return when {
            wasVirtual == null || wasVirtual == boat.isVirtual -> null
            wasVirtual -> Answer(Answer.Reason.OF_THE_VIRTUAL_BOAT)
            else -> Answer(Answer.Reason.OF_A_REAL_BOAT)
        }
    }

    /** Tells a mission that was started what a person wants. */
    fun tell(wish: Wish): Answer? {
        val run = this.run ?: return Answer(Answer.Reason.NOT_UNDER_WAY)
        return wish(run, wish)
    }

    /** What was stopped stays stopped, whatever is pressed while the board is being told. */
    private fun wish(run: MissionRun, wish: Wish): Answer? {
        if (run.isStopping) return Answer(Answer.Reason.OVER)
        run.wish = wish
        return null
    }

    /** The phone's charge, percent; null where it does not say. */
    fun phoneCharge(percent: Int?) {
        run?.phoneCharge(percent)
    }

    /** Ends the mission; it is over once the board has been told. */
    fun stop() {
        run?.stop()
    }

    /** Forgets the mission that is loaded; one that was cut off can still be gone on with. */
    fun clear(): Answer? {
        if (isUnderWay) return Answer(Answer.Reason.UNDER_WAY)
        recovered = null
        spec = null
        last = null
        keeper.mission = null
        return null
    }

    /** Does what is due at [seconds] on the phone's clock. */
    fun step(seconds: Double, pose: Pose) {
        val run = this.run ?: return
        run.step(seconds, pose)
        if (run.isOver) end()
    }

    /** Brings the log to the disk. */
    fun flush() {
        val log = run?.log ?: return
        if (flushing) return
        flushing = true
        disk.run {
            log.flush()
            disk.answer { flushing = false }
        }
    }

    /** Ends the mission now, whether the board has been told or not, and closes its log. */
    fun end() {
        val run = this.run ?: return
        val report = run.report(isOver = true)
        last = report
        this.run = null
        keeper.mission = null
        close(run.log, report)
    }

    /** The process goes: what is there goes to the disk, and the log stays incomplete. */
    fun leave() {
        val log = run?.log ?: return
        run = null
        disk.run {
            log.flush()
            log.release()
        }
    }

    /** Looks for past missions. */
    fun lookForPast() {
        disk.run {
            val found = folder.past()
            disk.answer { past = found }
        }
    }

    /** As of now; null where no mission is loaded. */
    fun report(): MissionReport? {
        val spec = this.spec ?: return null
        run?.let { return it.report(isOver = false) }
        return last ?: waiting(spec).also { last = it }
    }

    /** What became of the fixes that [pose] had. */
    fun fixes(pose: Pose): FixCounts =
        FixCounts(pose.fixes, pose.jumps, run?.wideFixes ?: 0, run?.refusedFixes ?: 0)

    private fun waiting(spec: MissionSpec): MissionReport {
        val found = recovered?.mission
        val map = (found?.estimator ?: spec.estimator.build(spec.grid.grid(), spec.probe)).map
        return MissionReport(
            spec,
            MissionState.Idle,
            Wish.GO_ON,
            isRecovered = found != null,
            isOver = false,
            map.copy(),
            position = null,
            recovered?.track?.places().orEmpty(),
            emptyList(),
            found?.used ?: 0.0,
            recovered?.trace?.points().orEmpty(),
            ReadingCounts(received = found?.readings ?: 0, taken = found?.readings ?: 0),
            recovered?.let { LogReport(it.name) },
            probeSilence = null,
            found?.givenUp ?: GivenUp(),
            restsFor = 0.0,
            DoubleArray(map.grid.size) { Double.NaN },
            now = 0.0,
        )
    }

    /** Again and again, where the disk takes nothing: what was measured is not given up while there is hope. */
    private fun close(log: LogFile, report: MissionReport) {
        disk.run {
            val isClosed = log.close()
            disk.answer {
                val shown = report.withLog(log.report)
                if (last === report) last = shown
                if (!isClosed) unclosed = log to shown
                lookForPast()
            }
        }
    }

    /** Tries to close a log that could not be. */
    fun closeAgain() {
        val (log, report) = unclosed ?: return
        unclosed = null
        close(log, report)
    }

    private companion object {
        /** What the name of a log begins with that no real boat wrote, so that no list takes it for measured. */
        const val VIRTUAL = "demo "
    }
}
