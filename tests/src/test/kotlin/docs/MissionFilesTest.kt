package stillwater.docs

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import stillwater.architecture.Repository
import stillwater.io.MissionFile
import stillwater.mission.Quantity
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** The example missions are missions that `simulate` can run. */
class MissionFilesTest {
    @TestFactory
    fun everyMissionFileIsReadAndAsksForWhatTheVirtualBoatHas(): List<DynamicTest> {
        val files = Repository.file("docs/missions").listFiles { it.extension == "json" }.orEmpty().sorted()
        assertTrue(files.isNotEmpty())
        return files.map { file ->
            dynamicTest(file.name) {
                val mission = MissionFile.read(file.toPath())
                assertEquals(Quantity.DISSOLVED_OXYGEN, mission.probe.quantity)
                assertTrue(mission.probe.port in listOf(null, 1), "port ${mission.probe.port}")
            }
        }
    }
}
