package stillwater.closedloop

import org.junit.jupiter.api.Test
import stillwater.model.Actuation
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class FaultCampaignTest {
    /** Two runs of each kind of fault and two of all at once; docs/safety.md has a thousand. Seeds fixed beforehand. */
    @Test
    fun whateverGoesWrongMotorsRestInTimeAndNothingIsLost() {
        val runs = (700_000L until 700_022L).map { FaultCampaign.run(it) }
        for (run in runs) assertEquals("", FaultCampaign.faultsFound(run), "seed ${run.case.seed}, ${run.kinds}")
        for (kind in FaultKind.entries) assertTrue(runs.any { it.occurred[kind.ordinal] > 0 }, "${kind.label} occurs")
        assertTrue(runs.sumOf { it.observer.underPower } > 1000, "boats go somewhere")
        assertTrue(runs.sumOf { it.verdicts.readings } > 1000, "boats read something")
    }

    /** A run that ends while its process is dead: the log is without the last second, and so is who goes on with it. */
    @Test
    fun aRunThatEndsWithADeadProcessIsJudgedByItsLog() {
        val dead = CampaignRun(CampaignCase(800_419), setOf(FaultKind.PROCESS_KILL)).apply { endsDead = true }.run()
        assertTrue(dead.occurred[FaultKind.PROCESS_KILL.ordinal] > 0 && dead.verdicts.readings > 0)
        assertEquals("", FaultCampaign.faultsFound(dead))
    }

    /** A pilot who bypasses the mission: the observer sees that it is beyond the fence and drives without a link. */
    @Test
    fun theObserverSeesWhatAMissionWouldNotTell() {
        val observers = (700_100L..700_102L).map { madPilot(CampaignRun(CampaignCase(it), setOf(FaultKind.LINK_CUT))) }
        assertTrue(observers.any { it.beyondMargin > 0 }, "beyond the margin")
        assertTrue(observers.any { it.tooLong > 0 }, "without a link")
    }

    private fun madPilot(run: CampaignRun): Observer {
        run.meanwhile = {
            val ahead = if (run.boat.spec.vectored) Actuation.Vectored(1.0, 0.0) else Actuation.Differential(1.0, 1.0)
            run.boat.phone.write(PlatypusEncoder.encode(Command.Move(ahead)))
        }
        return run.run().observer
    }
}
