package stillwater.cli

import org.junit.jupiter.api.BeforeEach
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.CsvSource
import java.net.InetAddress
import java.net.ServerSocket
import java.nio.file.Path
import kotlin.io.path.createDirectories
import kotlin.io.path.exists
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse

/** What `drive` and `virtual-boat` cannot use is one line and exit code 2, before any motor or file is touched. */
class DriveBadInputTest {
    @TempDir
    private lateinit var directory: Path
    private val out get() = directory.resolve("out")
    private val mission get() = directory.resolve("pond.json").toString()

    @BeforeEach
    fun thereIsAMission() {
        directory.resolve("pond.json").writeText(POND)
    }

    private fun assertRefused(message: String, vararg arguments: String) {
        val result = runBoatCommand(*arguments)
        assertEquals(2, result.statusCode, result.output)
        assertContains(result.stderr, message)
        assertEquals(1, result.stderr.trimEnd().lines().size, result.stderr)
        assertEquals("", result.stdout)
    }

    private fun drive(vararg more: String) = arrayOf("drive", mission, "--out", out.toString(), "--yes", *more)

    @ParameterizedTest
    @CsvSource(
        "'--port: expected a serial port such as /dev/ttyACM0 or COM3, or tcp:HOST:PORT', --port tcp:nowhere",
        "'--phone: expected tcp:HOST:PORT, found ''/dev/null''', --port tcp:localhost:1 --phone /dev/null",
        "'--baud: expected a whole number within 300..4000000', --port /dev/no-such-port --baud 12",
        "'/dev/no-such-port: expected a serial port, found none', --port /dev/no-such-port",
        "'--declination: expected an angle within -180..180 degrees', --port /dev/no-such-port --declination 200",
        "'--declination: expected either --declination or --phone', --port COM3 --phone tcp:a:1 --declination 2",
        "'--baud: expected a serial --port to go with it, found tcp:a:1', --port tcp:a:1 --baud 9600",
        "'--resume: expected an unfinished mission', --port /dev/no-such-port --resume",
    )
    fun flagsThatCannotBeUsed(message: String, flags: String) {
        assertRefused(message, *drive(*flags.split(' ').toTypedArray()))
        assertFalse(out.exists())
    }

    /** Before it serves, not when it has. */
    @Test
    fun anOutputThatIsAFile() {
        val file = directory.resolve("truth.csv").also { it.writeText("kept") }
        val flags = arrayOf("virtual-boat", mission, "--tcp", "0", "--for", "0.1", "--out", file.toString())
        assertRefused("stillwater virtual-boat: output $file is a file; name a directory", *flags)
        assertEquals("kept", file.readText())
    }

    @Test
    fun aBoardThatDoesNotListen() {
        val free = ServerSocket(0, 1, InetAddress.getLoopbackAddress()).use { it.localPort }
        val port = "tcp:127.0.0.1:$free"
        assertRefused("$port: expected a board that listens, found", *drive("--port", port))
        assertFalse(out.exists())
    }

    @Test
    fun aMissionThatIsNone() {
        directory.resolve("pond.json").writeText(POND.replace("\"columns\":4", "\"columns\":0"))
        assertRefused("pond.json:3", *drive("--port", "tcp:localhost:1"))
        assertRefused("pond.json:3", "virtual-boat", mission, "--tcp", "0")
        assertRefused("no such file", "virtual-boat", directory.resolve("none.json").toString(), "--tcp", "0")
    }

    @Test
    fun aDirectoryThatHasALogAlready() {
        out.createDirectories()
        out.resolve("mission.txt").writeText("kept")
        assertRefused("expected a directory without a mission", *drive("--port", "tcp:localhost:1"))
        out.resolve("mission.txt").toFile().delete()
        out.resolve("mission.txt.incomplete").writeText("kept")
        assertRefused("--resume goes on with it", *drive("--port", "tcp:localhost:1"))
        assertEquals("kept", out.resolve("mission.txt.incomplete").readText())
    }

    @Test
    fun anUnfinishedLogOfAnotherMissionOrOfNone() {
        out.createDirectories()
        val log = out.resolve("mission.txt.incomplete")
        ServerSocket(0, 20, InetAddress.getLoopbackAddress()).use { board ->
            val port = "tcp:127.0.0.1:${board.localPort}"
            val flags = arrayOf("--port", port, "--phone", port, "--resume")
            log.writeText("nothing\n")
            assertRefused("expected a mission's log, found no mission that can be read", *drive(*flags))
            val lines = sailed(51, 10).first.joinToString("") { "$it\n" }
            log.writeText(lines)
            directory.resolve("pond.json").writeText(POND.replace("\"pond\"", "\"lake\""))
            assertRefused("expected the mission of $mission, found another one, pond", *drive(*flags))
            assertEquals(lines, log.readText())
            val other = POND.replace("\"seconds\":300", "\"seconds\":301").replace("\"port\":1,", "")
            directory.resolve("pond.json").writeText(other)
            val keys = "probe.port is 1, not left out, budget.seconds is 300.0, not 301.0"
            assertRefused("found another one of the same name, in which $keys", *drive(*flags))
            directory.resolve("pond.json").writeText(POND)
            assertRefused("found it with boat.mixing differential; leave --vectored", *drive(*flags, "--vectored"))
            val vectored = "\"boat\":{\"mixing\":\"vectored\"},\"home\""
            directory.resolve("pond.json").writeText(POND.replace("\"home\"", vectored))
            assertRefused("found it with boat.mixing differential", *drive(*flags))
            assertEquals(lines, log.readText())
        }
    }

    @Test
    fun aVirtualBoatThatCannotBeServed() {
        assertRefused("expected one of --pty and --tcp PORT, found neither", "virtual-boat", mission)
        val both = arrayOf("virtual-boat", mission, "--tcp", "1", "--pty")
        assertRefused("expected one of --pty and --tcp PORT, found both", *both)
        assertRefused("--tcp: expected a port in 0..65535", "virtual-boat", mission, "--tcp", "65536")
        assertRefused("--firmware: expected one of v4.2.0, master", "virtual-boat", mission, "--firmware", "v5")
        assertRefused("--speed: expected a number within", "virtual-boat", mission, "--tcp", "0", "--speed", "0")
        ServerSocket(0, 1, InetAddress.getLoopbackAddress()).use { taken ->
            val port = "${taken.localPort}"
            assertRefused("cannot listen there", "virtual-boat", mission, "--tcp", port, "--host", "127.0.0.1")
        }
        directory.resolve("pond.json").writeText(POND.replace("dissolved-oxygen", "acidity"))
        assertRefused("which the virtual boat has, found acidity on port 1", "virtual-boat", mission, "--tcp", "0")
    }
}
