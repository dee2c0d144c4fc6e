package stillwater.app.service

import org.junit.rules.ExternalResource
import org.robolectric.RuntimeEnvironment
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionState
import stillwater.mission.RecoveredMission
import java.io.File
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** The service on a desk with a mission loaded and a green checklist before each test; gone after it. */
internal class Pond : ExternalResource() {
    val wire = DirectWire()
    val desk = ServiceDesk(wire)

    override fun before() {
        desk.start()
        load()
    }

    override fun after() = desk.end()

    /** Loads [spec], and waits for a green checklist. */
    fun load(spec: String = ServiceDesk.POND) {
        desk.ask { load(spec) }
        green()
    }

    /** Waits for a green checklist. */
    fun green() {
        val isGreen = desk.until(10.0) { shot -> shot.mission != null && shot.preflight.all { it.ready } }
        assertTrue(isGreen, "${desk.snapshot.preflight}")
    }

    /** Starts, and waits until the survey has begun. */
    fun survey() {
        desk.ask { start() }
        assertTrue(desk.until(25.0) { it.mission?.state == MissionState.Surveying }, "${desk.snapshot.answer}")
    }

    /** The logs on the disk, oldest first. */
    fun logs(): List<File> =
        BoatService.logOf(RuntimeEnvironment.getApplication(), "").listFiles().orEmpty().sorted()

    /** What [file] tells. */
    fun read(file: File): RecoveredMission =
        assertNotNull(MissionRecovery().apply { file.forEachLine { line(it) } }.recovered())
}
