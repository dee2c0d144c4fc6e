package stillwater.survey

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.assertThrows
import stillwater.io.LogPass
import stillwater.io.LogProblem
import stillwater.io.ReadingSink
import stillwater.io.SurveyLog
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LocalFrame
import stillwater.run.FilterKind
import java.nio.file.Path
import java.util.concurrent.Callable
import java.util.concurrent.Executors
import kotlin.test.assertEquals

/** Reading and the look at what was read go on at once, for any number of maps, and end together. */
@Timeout(60)
class SurveyMapThreadsTest {
    /** More readings than may wait for the look, the last of them bad if [isBad]. */
    private class Log(private val isBad: Boolean) : SurveyLog {
        override val file: Path = Path.of("log.csv")
        override val format = "made up"
        override val quantity = "v"
        override val xName = "x_m"
        override val oneDimensional = false
        override val frame: LocalFrame? = null

        override fun read(progress: (Long) -> Unit, sink: ReadingSink): LogPass {
            repeat(SIZE) {
                val x = (it % 1000).toDouble()
                sink.take(BoatTime(it.toDouble()), x, (it / 1000).toDouble(), 8 + x / 1000, Conditions.NONE)
            }
            if (isBad) throw LogProblem(file, SIZE + 2L, "v", "a finite number", "'no'")
            return LogPass(SIZE.toLong(), emptyMap())
        }
    }

    private val settings = MapSettings(filters = listOf(FilterKind.AVERAGING))

    @Test
    fun aBadLastRowEndsBoth() {
        val problem = assertThrows<LogProblem> { SurveyMap.of(Log(isBad = true), settings) }
        assertEquals(SIZE + 2L, problem.line)
    }

    @Test
    fun severalMapsAtOnceAllEnd() {
        val threads = Executors.newFixedThreadPool(MAPS)
        try {
            val maps = threads.invokeAll(List(MAPS) { Callable { SurveyMap.of(Log(isBad = false), settings) } })
            assertEquals(List(MAPS) { SIZE.toLong() }, maps.map { it.get().pass.readings })
        } finally {
            threads.shutdownNow()
        }
    }

    private companion object {
        const val SIZE = 50_000
        const val MAPS = 4
    }
}
