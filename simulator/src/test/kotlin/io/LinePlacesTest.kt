package stillwater.io

import org.junit.jupiter.api.io.TempDir
import stillwater.model.Position
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertEquals

/** A log with metres along a line alone. */
class LinePlacesTest {
    @TempDir
    private lateinit var directory: Path

    @Test
    fun metresAlongALineAreAPlaceWhereNoneIsNeeded() {
        val file = directory.resolve("line.csv").apply { writeText("time_s,x_m,DO,sample\n0,5,8.1,8\n60,7,8.2,8\n") }
        val choice = LogChoice(value = "DO", conditions = mapOf("reference" to "sample"), needsPlace = false)
        val log = SurveyLog.open(file, choice)
        val places = log.readings().map { it.position }
        assertEquals(listOf(Position(5.0, 0.0), Position(7.0, 0.0)), places)
    }
}
