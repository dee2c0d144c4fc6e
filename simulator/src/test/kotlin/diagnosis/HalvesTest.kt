package stillwater.diagnosis

import com.github.ajalt.clikt.core.parse
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.DiagnoseCommand
import java.nio.file.Files
import java.nio.file.Path
import kotlin.test.Test
import kotlin.test.assertTrue

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
    fun nothingIsNamedInARealSurveyThatItsHalvesDoNotName() {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        val log = Path.of(data, "catabot", "catabot_china_20200915.csv")
        val whole = named(log)
        if (whole.isEmpty()) return
        val lines = Files.readAllLines(log)
        val middle = lines.size / 2
        for (rows in listOf(lines.subList(1, middle), lines.subList(middle, lines.size))) {
            val half = Files.write(directory.resolve("half.csv"), listOf(lines[0]) + rows)
            assertTrue(named(half).containsAll(whole), "$whole is not named in ${rows.size} rows of it")
        }
    }
}
