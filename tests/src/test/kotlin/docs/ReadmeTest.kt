package stillwater.docs

import kotlinx.coroutines.runBlocking
import stillwater.benchmark.BenchmarkTable
import stillwater.run.Experiment
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import java.io.File
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What the README says the program prints is what it prints. */
class ReadmeTest {
    private val readme = generateSequence(File("").absoluteFile) { it.parentFile }
        .first { it.resolve("settings.gradle.kts").isFile }
        .resolve("README.md")
        .readText()

    @Test
    fun theTableIsWhatTheBenchmarkPrints() {
        val settings = Preset.REPORT.settings()
        val uniform = settings.copy(fields = settings.fields.filterKeys { it == Preset.UNIFORM })
        val result = runBlocking { Experiment(uniform).run(threads = 2) }
        for (row in BenchmarkTable.of(result, Preset.UNIFORM).rows) {
            val line = "| ${row[0]}, ${row[1]} | ${row.drop(2).joinToString(" | ")} |"
            assertTrue(line in readme, "README.md has no line\n$line")
        }
    }

    @Test
    fun itNamesTheTwoCommandsAndTheLicence() {
        val run = "mvn -q -pl simulator -am -DskipTests package && java -jar simulator/target/stillwater.jar benchmark"
        for (text in listOf(run, "mvn verify", "Apache-2.0")) assertTrue(text in readme, text)
    }

    @Test
    fun theSensorSpecIsOne() {
        val json = readme.substringAfter("```json\n").substringBefore("```")
        assertEquals(4, SensorSpec.fromJson(json).stages.size)
    }
}
