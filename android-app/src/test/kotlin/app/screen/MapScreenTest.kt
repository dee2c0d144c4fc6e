package stillwater.app.screen

import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import stillwater.app.R
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
class MapScreenTest {
    private val activity = Window().activity
    private val map get() = activity.view<MapView>(R.id.map)
    private val waiting = Scenes.standingBy.copy(mission = Scenes.report(MissionState.Idle, position = null))
    private val origin = Scenes.spec.origin
    private val frame = LocalFrame(LatLon(origin.latitude, origin.longitude))

    private fun at(x: Double, y: Double, ageSeconds: Double) =
        waiting.copy(
            fix = waiting.fix?.copy(place = frame.toLatLon(Position(x, y))),
            fixAgeSeconds = ageSeconds,
        )

    @Test
    fun beforeTheStartTheBoatIsWhereThePhoneIs() {
        activity.show(at(20.0, 10.0, ageSeconds = 0.5))
        assertTrue(assertNotNull(map.scene.boat).distanceTo(Position(20.0, 10.0)) < 0.01) // m; a fix is not better
    }

    /** The phone was carried on, its receiver sees no sky: where it was a minute ago is not where the boat is. */
    @Test
    fun anOldFixIsNotTheBoatsPlace() {
        activity.show(at(20.0, 10.0, ageSeconds = 0.5))
        activity.show(at(20.0, 10.0, ageSeconds = 3.5))
        assertNull(map.scene.boat)
        activity.show(waiting.copy(fix = null, fixAgeSeconds = null))
        assertNull(map.scene.boat)
    }

    @Test
    fun aPhoneAtAnotherWaterIsNotOnThisMap() {
        activity.show(at(5_000.0, 10.0, ageSeconds = 0.5))
        assertNull(map.scene.boat)
    }

    @Test
    fun underWayTheMissionKnowsItsBoatAndAfterwardsItDoesNot() {
        activity.show(at(20.0, 10.0, ageSeconds = 99.0).copy(mission = Scenes.report))
        assertEquals(Scenes.report.position, map.scene.boat)
        val over = Scenes.report(MissionState.Stopped(StopReason.COMPLETED), isOver = true)
        activity.show(at(20.0, 10.0, ageSeconds = 99.0).copy(mission = over))
        assertNull(map.scene.boat, "it may have drifted, or been taken ashore")
        activity.show(at(20.0, 10.0, ageSeconds = 0.5).copy(mission = over))
        assertTrue(assertNotNull(map.scene.boat).distanceTo(Position(20.0, 10.0)) < 0.01)
    }
}
