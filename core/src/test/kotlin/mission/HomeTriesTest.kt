package stillwater.mission

import stillwater.control.Danger
import stillwater.control.Failsafe
import stillwater.control.Ruling
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Ways home in vain, each a minute long. */
class HomeTriesTest {
    private val tries = HomeTries(nearer = 4.5)
    private var now = 0.0

    private fun waysUntilRest(left: (Int) -> Double = { 100.0 }, isAlong: (Int) -> Boolean = { false }): Int {
        var ways = 0
        do {
            now += 60
            ways++
        } while (tries.heldUp(now, left(ways), isAlong(ways)))
        return ways
    }

    @Test
    fun restsGrowLongerAndTheLastIsForGood() {
        assertEquals(10, waysUntilRest())
        for (rest in listOf(600.0, 1200.0, 2400.0, 4800.0, 9600.0)) {
            assertEquals(rest, tries.restsFor(now))
            assertFalse(tries.isStranded)
            now += rest
            assertEquals(0.0, tries.restsFor(now))
            assertEquals(3, waysUntilRest())
        }
        assertTrue(tries.isStranded)
        assertEquals(0.0, tries.restsFor(now))
    }

    @Test
    fun waysThatLeadAlongWhatIsInTheWayMayBeMore() {
        assertEquals(60, waysUntilRest(isAlong = { true }))
        assertEquals(3, waysUntilRest())
        now += 3600
        assertEquals(6, waysUntilRest(isAlong = { it == 2 || it == 4 }))
    }

    @Test
    fun aBoatThatComesNearerHasTheFirstTenAgain() {
        assertEquals(19, waysUntilRest(left = { if (it < 10) 100.0 else 90.0 }))
    }

    @Test
    fun aRestThatIsEndedBeginsTheCountAnew() {
        assertEquals(10, waysUntilRest())
        tries.beginAnew()
        assertEquals(0.0, tries.restsFor(now))
        assertEquals(10, waysUntilRest())
        assertEquals(600.0, tries.restsFor(now))
    }

    @Test
    fun aRestIsGoneOnWithAfterARestart() {
        assertEquals(null, tries.rest(now))
        repeat(2) {
            waysUntilRest()
            now += tries.restsFor(now) / 2
            assertEquals(HomeRest(it + 1, tries.restsFor(now)), tries.rest(now))
            if (it == 0) now += tries.restsFor(now)
        }
        // The clock may have begun anew.
        val again = HomeTries(nearer = 4.5).apply { resume(checkNotNull(tries.rest(now)), 7.0) }
        assertEquals(600.0, again.restsFor(7.0))
        assertEquals(0.0, again.restsFor(607.0))
        now = 607.0
        var ways = 0
        do ways++ while (again.heldUp(now, 100.0, isAlong = false))
        assertEquals(3, ways)
        assertEquals(2400.0, again.restsFor(now), "the third")
    }

    @Test
    fun whoIsStrandedIsStoppedAndWhoRestsIsNot() {
        fun next(danger: Danger) = MissionPhases.next(
            MissionState.Returning(Danger.BUDGET_SPENT),
            PhaseInput(Ruling.Fall(danger, Failsafe.STOP), board = null, isHome = false, rearms = true),
        )
        assertEquals(MissionState.Stopped(StopReason.STRANDED), next(Danger.STRANDED))
        assertEquals(MissionState.Holding(Danger.HELD_UP), next(Danger.HELD_UP))
    }
}
