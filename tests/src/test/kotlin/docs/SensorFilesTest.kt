package stillwater.docs

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import stillwater.architecture.Repository
import stillwater.sensor.SensorSpec
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** The sensors that docs/results.md runs are sensors that the program reads. */
class SensorFilesTest {
    @TestFactory
    fun everySensorFileIsReadAndNamedAsItsFile(): List<DynamicTest> {
        val files = Repository.file("docs/sensors").listFiles { it.extension == "json" }.orEmpty().sorted()
        assertTrue(files.isNotEmpty())
        return files.map { file ->
            dynamicTest(file.name) {
                assertEquals(file.nameWithoutExtension, SensorSpec.fromJson(file.readText()).name)
            }
        }
    }
}
