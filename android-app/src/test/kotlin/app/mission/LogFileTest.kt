package stillwater.app.mission

import org.junit.Rule
import org.junit.Test
import org.junit.rules.TemporaryFolder
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import stillwater.estimate.AveragingFilter
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import stillwater.model.Reading
import java.io.File
import java.io.IOException
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Inside of an Android: Kotlin's `addSuppressed` asks for its version, which outside of one breaks it for all that follow. */
@RunWith(RobolectricTestRunner::class)
class LogFileTest {
    @get:Rule
    val temporary = TemporaryFolder()
    private val file get() = File(temporary.root, "a.log.incomplete")
    private val room = { Long.MAX_VALUE }

    @Test
    fun linesAreOnTheDiskAfterAFlushAndTheNameTellsTheEnd() {
        val log = LogFile(file, LogOpener(::FileOutput), room)
        log.line("one")
        log.line("zwei, äöü")
        assertFalse(file.exists(), "a line never waits for the disk")
        log.flush()
        assertEquals("one\nzwei, äöü\n", file.readText())
        assertTrue(log.close())
        assertEquals(LogReport("a.log", lines = 2, written = 2, isClosed = true), log.report)
        assertEquals(listOf("a.log"), temporary.root.list().orEmpty().toList())
    }

    @Test
    fun aLineThatWasCutIsNotJoinedWithTheNext() {
        file.writeText("one\ntw")
        val log = LogFile(file, LogOpener(::FileOutput), room)
        log.line("three")
        log.flush()
        log.release()
        assertEquals("one\ntw\nthree\n", file.readText())
    }

    @Test
    fun whatTheDiskDoesNotTakeIsKeptTriedAgainAndAtLastCountedAsLost() {
        var isFull = true
        val taken = mutableListOf<String>()
        val output =
            object : LogOutput {
                override fun append(bytes: ByteArray) {
                    if (isFull) throw IOException("full")
                    taken += String(bytes)
                }

                override fun close() = Unit
            }
        val log = LogFile(file, { output }, room)
        log.line("first")
        log.flush()
        assertTrue(log.failed)
        assertEquals(LogProblem(LogProblem.Reason.NOT_WRITTEN, "full"), log.report.problem)
        val megabyte = "x".repeat(1 shl 20)
        repeat(6) {
            log.line(megabyte)
            log.flush()
        }
        assertFalse(log.close(), "lines are missing")
        isFull = false
        assertTrue(log.close())
        assertEquals("first\n", taken.first())
        val report = log.report
        assertEquals(7L, report.lines)
        assertEquals(report.lines, report.written + report.lost)
        assertTrue(report.lost in 2..3, "$report")
        assertTrue(log.failed, "it is not forgotten that it failed")
    }

    @Test
    fun aFileThatCannotBeClosedIsTroubleAndNothingElse() {
        val output =
            object : LogOutput {
                override fun append(bytes: ByteArray) = Unit

                override fun close(): Unit = throw IOException("gone")
            }
        val log = LogFile(file, { output }, room)
        log.line("one")
        assertTrue(log.close())
        assertEquals(LogProblem(LogProblem.Reason.NOT_WRITTEN, "gone"), log.report.problem)
        assertEquals(1L, log.report.written)
    }

    @Test
    fun littleRoomIsTroubleBeforeTheDiskIsFull() {
        val log = LogFile(file, LogOpener(::FileOutput)) { 1_000_000 }
        log.line("one")
        log.flush()
        assertTrue(log.failed)
        assertEquals(1L, log.report.written)
        assertEquals(LogProblem(LogProblem.Reason.LITTLE_ROOM), log.report.problem)
    }

    @Test
    fun aFolderThatCannotBeMadeIsTrouble() {
        val log = LogFolder({ File(temporary.newFile(), "missions") }, room = room).begin("pond", epochMillis = 0)
        log.line("one")
        log.flush()
        assertEquals(LogProblem(LogProblem.Reason.NO_FOLDER), log.report.problem)
    }

    /** The kernel's own full disk, where there is one. */
    @Test
    fun aDiskThatIsReallyFullLeavesNothingHalfWritten() {
        val full = File("/dev/full")
        org.junit.Assume.assumeTrue("no $full here", full.exists())
        assertFailsWith<IOException> { FileOutput(full).append("line\n".toByteArray()) }
    }

    /** However long the log was: the way stays whole and becomes coarser, of the readings the last ones stay. */
    @Test
    fun trackAndTraceAreOfAFixedSize() {
        val track = Track()
        val way = List(50_000) { Position(it.toDouble(), 0.0) }
        way.forEach(track::add)
        val kept = track.places()
        assertTrue(kept.size in 2_000..4_000, "${kept.size}")
        assertEquals(way.first(), kept.first())
        assertTrue(kept.last().distanceTo(way.last()) <= kept[1].distanceTo(kept[0]))
        val trace = Trace()
        val map = AveragingFilter(Grid(Position(0.0, 0.0), 1, 1, 10.0), Interval(0.0, 9.0)).map
        repeat(5_000) { trace.take(Reading(BoatTime(it.toDouble()), Position(5.0, 5.0), 1.0), map) }
        assertEquals(600, trace.points().size)
        assertEquals(4_999.0, trace.points().last().seconds)
    }

    @Test
    fun theFolderKnowsTheNewestThatIsIncompleteAndListsAll() {
        val folder = LogFolder({ temporary.root }, room = room)
        val log = folder.begin("Lac d'Argent / 2", epochMillis = 1_700_000_000_000)
        log.line("no mission")
        log.flush()
        log.release()
        val name = "2023-11-14T22-13-20-Lac-d-Argent---2.log.incomplete"
        assertEquals(listOf(name), folder.past().map { it.name })
        assertEquals(null, folder.recover(), "it has no mission in it")
        assertEquals(null, folder.recover(name))
        assertTrue(folder.goOn(name).close())
        assertEquals(listOf(true), folder.past().map { it.isComplete })
        val complete = name.removeSuffix(LogFolder.INCOMPLETE)
        assertEquals(null, folder.recover(complete), "what is complete is not gone on with")
    }
}
