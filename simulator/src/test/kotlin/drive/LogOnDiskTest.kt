package stillwater.drive

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.report.OutputException
import java.io.ByteArrayOutputStream
import java.io.IOException
import java.nio.ByteBuffer
import java.nio.file.Path
import kotlin.io.path.createDirectories
import kotlin.io.path.exists
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertNull
import kotlin.test.assertTrue

class LogOnDiskTest {
    @TempDir
    private lateinit var directory: Path

    /** A disk with [room] for so many more bytes; takes at most [piece] at once. */
    private class SmallDisk(var room: Int, private val piece: Int = Int.MAX_VALUE) : LogBytes {
        val written = ByteArrayOutputStream()
        var isClosed = false
        var failsToForce = false

        override fun write(bytes: ByteBuffer) {
            val count = minOf(bytes.remaining(), room, piece)
            if (count == 0) throw IOException("No space left on device")
            written.write(bytes.array(), bytes.position(), count)
            bytes.position(bytes.position() + count)
            room -= count
        }

        override fun force() {
            if (failsToForce) throw IOException("Input/output error")
        }

        override fun close() {
            isClosed = true
        }
    }

    private val path get() = directory.resolve("mission.txt.incomplete")

    @Test
    fun aLogInWhichNothingWasWrittenIsNoneToGoOnWith() {
        LogOnDisk.begin(directory).close()
        assertFalse(path.exists(), "closed")
        path.writeText("")
        assertNull(LogOnDisk.unfinished(directory), "left by a program that was killed")
        LogOnDisk.begin(directory).use { it.line("0\tI\t{}") }
        assertEquals(path, LogOnDisk.unfinished(directory))
    }

    @Test
    fun aDiskThatWasFullForAMomentGetsEveryByteOnce() {
        val seed = 20_261_123L
        val random = Random(seed)
        repeat(200) { round ->
            val disk = SmallDisk(0, 1 + random.nextInt(40))
            val log = LogOnDisk(path, disk)
            val lines = StringBuilder()
            repeat(20) {
                val line = "line $it of µ " + "x".repeat(random.nextInt(60))
                log.line(line)
                lines.append(line).append('\n')
                disk.room = if (random.nextBoolean()) random.nextInt(80) else 10_000
                disk.failsToForce = random.nextInt(4) == 0
                runCatching { log.flush() }.onFailure { assertTrue(it is OutputException, "$it") }
                assertTrue(
                    lines.toString().toByteArray().take(disk.written.size()) == disk.written.toByteArray().toList(),
                )
                assertEquals(lines.toString().toByteArray().size, disk.written.size() + log.pending)
            }
            disk.room = 10_000
            disk.failsToForce = false
            log.close()
            assertEquals(lines.toString(), disk.written.toString(Charsets.UTF_8), "seed $seed, round $round")
            assertTrue(disk.isClosed)
        }
    }

    @Test
    fun aDiskThatStaysFullIsNamedAndTheFileIsClosed() {
        val disk = SmallDisk(3)
        val log = LogOnDisk(path, disk)
        log.line("a line")
        val full = assertFailsWith<OutputException> { log.close() }
        assertContains(full.message.orEmpty(), "cannot write the log $path: No space left on device")
        assertTrue(disk.isClosed)
        log.close()
        assertEquals("a l", disk.written.toString(Charsets.UTF_8))
    }

    @Test
    fun whatADiskDoesNotTakeIsToldInLines() {
        val disk = SmallDisk(5)
        val log = LogOnDisk(path, disk)
        listOf("one", "two", "three").forEach(log::line)
        val missing = log.missing().orEmpty()
        assertContains(missing, "$path lacks the last 2 lines")
        disk.room = 4
        assertContains(log.missing().orEmpty(), "lacks the last 1 line,")
        disk.room = 100
        assertNull(log.missing())
        assertEquals("one\ntwo\nthree\n", disk.written.toString(Charsets.UTF_8))
    }

    @Test
    fun aLogHasItsFinalNameWhenItIsCompleteOnly() {
        val out = directory.resolve("out").createDirectories()
        val log = LogOnDisk.begin(out)
        log.line("one")
        assertFalse(out.resolve("mission.txt").exists())
        assertEquals(out.resolve("mission.txt"), log.complete())
        assertEquals("one\n", out.resolve("mission.txt").readText())
        assertFalse(LogOnDisk.unfinished(out)?.exists() ?: false)
        log.close()
    }
}
