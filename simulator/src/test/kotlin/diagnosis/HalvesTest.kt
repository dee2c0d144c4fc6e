package stillwater.diagnosis

import com.github.ajalt.clikt.core.parse
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.DiagnoseCommand
import java.nio.file.Files
import java.nio.file.Path
import kotlin.test.Test
import kotlin.test.assertEquals

/** A survey of a lake that changes while the boat is on it. */
class HalvesTest {
    @TempDir
    private lateinit var directory: Path

    /** What is named for certain in [log]; empty where nothing is. */
    private fun named(log: Path): List<String> {
        val out = directory.resolve("out")
        DiagnoseCommand().parse(
            listOf("$log", "--value", "do_pct_sat", "--out", "$out", "--numbers-only", "--quiet"),
        )
        val json = Json.parseToJsonElement(Files.readString(out.resolve("diagnosis.json"))).jsonObject
        return json.getValue("causes").jsonArray.map { it.jsonPrimitive.content } - setOf("none", "unexplained")
    }

    @Test
    @Tag("long")
    fun nothingIsNamedInARealSurveyThatItsHalvesContradict() {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        // Each half alone called it jumps at times of its own.
        assertEquals(emptyList(), named(Path.of(data, "catabot", "catabot_china_20200915.csv")))
    }
}
