package stillwater.drive

import com.github.ajalt.mordant.terminal.Terminal
import com.github.ajalt.mordant.terminal.TerminalRecorder
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.POND
import stillwater.link.BoardWire
import stillwater.link.ReconnectingWire
import stillwater.link.WireOpener
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.virtual.BoardSpec
import stillwater.wire.ByteLink
import stillwater.world.VirtualWorld
import stillwater.world.WorldSettings
import stillwater.world.WorldSite
import java.nio.file.Path
import java.util.concurrent.CountDownLatch
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** `drive`'s loop with a virtual boat in virtual time; its wire and its phone do what the test says. */
class DriveRunTest {
    @TempDir
    private lateinit var directory: Path
    private val spec = MissionSpec.fromJson(POND)
    private val said = StringBuilder()
    private val reopened = CountDownLatch(1)
    private var recorder = TerminalRecorder()

    /** The boat's end of a wire until it is cut. */
    private inner class Wire(private val link: ByteLink) : BoardWire {
        var isCut = false

        override fun read(into: ByteArray) = if (isCut) ByteLink.LOST else link.read(into)

        override fun write(bytes: ByteArray): Boolean {
            if (!isCut) said.append(bytes.decodeToString())
            return !isCut && link.write(bytes)
        }

        override fun close() = Unit
    }

    /** A boat, its phone, and a run with both. Steps are of 0.1 s; [meanwhile] is called before each. */
    private inner class Afloat(board: BoardSpec = BoardSpec(oxygenPeriod = 1.0)) {
        val world = VirtualWorld(WorldSettings(seed = 71, board = board), WorldSite.of(spec))
        val first = Wire(world.boat.phone)
        val wire = ReconnectingWire(WireOpener { Wire(world.boat.phone).also { reopened.await() } }, first, rest = {})
        val prompt = PromptWire(wire)
        val file = LogOnDisk.begin(directory)
        val log = MissionLog(file, LogStart(1_700_000_000_000, "2023"), spec)
        val mission = Mission(spec, prompt, log)
        var meanwhile: (Int) -> Unit = { }
        var seesGps = true
        private var steps = 0
        private val phone = object : Phone {
            override fun await(): Moment {
                meanwhile(steps++)
                check(steps < MOST_STEPS) { "this never ends" }
                world.advance(0.1)
                val fix = world.boat.takeFix()?.takeIf { seesGps }?.let { PhoneFix(it.time, it.place) }
                return Moment(world.time, listOfNotNull(fix), world.boat.heading(), world.boat.yawRate)
            }

            override fun done() = Unit

            override fun trouble() = ""

            override fun close() = Unit
        }
        private val status = DriveStatus(Terminal(terminalInterface = recorder), wire, phone, isQuiet = false)
        val run = DriveRun(mission, phone, wire, prompt, file, status)

        fun sail(): StopReason? = file.use { run.sail() }
    }

    @Test
    fun aBlankLineBeginsAndAnyOtherEnds() {
        for (word in listOf("stop", "Stop", "STOP", "stop!", "quit", "no", " x")) {
            val afloat = Afloat()
            afloat.meanwhile = { step ->
                if (step == 40) afloat.run.heed("  ")
                if (afloat.mission.state == MissionState.Surveying) afloat.run.heed(word)
            }
            assertEquals(StopReason.OPERATOR, afloat.sail(), word)
            assertTrue(afloat.world.boat.board.actuation.isAtRest, word)
            directory.resolve("mission.txt.incomplete").toFile().delete()
        }
    }

    @Test
    fun aWordBeforeTheBeginningEndsItAndNothingIsArmed() {
        for (word in listOf("quit", "no", "STOP")) {
            said.clear()
            val afloat = Afloat()
            afloat.meanwhile = { step ->
                if (step == 40) afloat.run.heed(word)
                if (step == 41) afloat.run.heed("")
            }
            assertNull(afloat.sail(), word)
            assertFalse("\"arm\"" in said, word)
            directory.resolve("mission.txt.incomplete").toFile().delete()
        }
    }

    @Test
    fun withoutAnybodyToBeginItItEnds() {
        val afloat = Afloat()
        assertTrue(afloat.run.heedSilence())
        assertNull(afloat.sail())
        afloat.run.start()
        assertFalse(afloat.run.heedSilence(), "a mission that was begun goes on")
    }

    /** Whoever waits ashore is told what for, whenever that changes, and not every step. */
    @Test
    fun beforeTheBoatMovesItIsSaidWhatItWaitsFor() {
        recorder = TerminalRecorder(outputInteractive = false)
        val afloat = Afloat()
        afloat.first.isCut = true
        afloat.seesGps = false
        afloat.run.start()
        afloat.meanwhile = { step ->
            if (step == 200) reopened.countDown()
            if (step == 400) afloat.seesGps = true
            if (afloat.mission.state == MissionState.Surveying) afloat.run.stop()
        }
        assertEquals(StopReason.OPERATOR, afloat.sail())
        val lines = recorder.stdout().lines().filter { "preflight" in it || "arming" in it }
        assertContains(lines.first(), "nothing heard from the board: is it on, is --port right?; no fix yet")
        val fixless = lines.filter { "(no fix yet)" in it }
        assertTrue(fixless.size in 1..3, "$lines")
        assertContains(lines.joinToString("\n"), "(fixes have to agree for some 15 s, and a heading is needed)")
        assertContains(lines.joinToString("\n"), "the board was told to arm")
        assertTrue(lines.size <= 12, "$lines")
    }

    @Test
    fun aMissionThatIsStoppedWhileItsBoardArmsIsDisarmed() {
        val afloat = Afloat()
        afloat.run.start()
        afloat.meanwhile = { if (afloat.mission.state == MissionState.Arming) afloat.run.stop() }
        assertEquals(StopReason.OPERATOR, afloat.sail())
        assertContains(said.substring(said.indexOf("\"arm\"")), "\"disarm\"")
        afloat.world.advance(10.0)
        assertTrue(afloat.world.boat.board.actuation.isAtRest)
    }

    @Test
    fun aWireThatIsLostAtTheEndIsWaitedFor() {
        val afloat = Afloat()
        afloat.run.start()
        var cutAt = Int.MAX_VALUE
        afloat.meanwhile = { step ->
            if (afloat.mission.state == MissionState.Surveying && !afloat.first.isCut) {
                afloat.run.stop()
                afloat.first.isCut = true
                said.clear()
                cutAt = step
            }
            if (step == cutAt + 10) {
                reopened.countDown()
                while (afloat.wire.read(ByteArray(0)) == ByteLink.LOST) Thread.onSpinWait()
            }
        }
        assertEquals(StopReason.OPERATOR, afloat.sail())
        assertContains(said, "\"disarm\"", message = "told on the wire that was opened again")
    }

    @Test
    fun whateverIsThrownTheBoardIsLeftAtRestAndDisarmed() {
        val afloat = Afloat()
        afloat.run.start()
        afloat.meanwhile = {
            if (afloat.mission.readings.passed > 5) {
                said.clear()
                error("a mistake")
            }
        }
        assertEquals("a mistake", assertFailsWith<IllegalStateException> { afloat.sail() }.message)
        assertContains(said, "{\"m0\":{\"v\":0},\"m1\":{\"v\":0}}\n{\"e\":{\"cmd\":\"disarm\"}}\n")
        afloat.world.advance(0.5)
        assertTrue(afloat.world.boat.board.actuation.isAtRest)
        assertTrue(LogOnDisk.unfinished(directory) != null, "the log can be gone on with")
    }

    @Test
    fun aProbeThatIsSilentShowsWhileUnderWay() {
        val afloat = Afloat(BoardSpec(oxygenPeriod = 500.0))
        afloat.run.start()
        afloat.meanwhile = { if (it == 700) afloat.run.stop() }
        afloat.sail()
        assertContains(recorder.stdout(), Regex("surveying, no dissolved oxygen on port 1 for \\d+ s"))
    }

    /** A terminal may be of any size, and one that does not know its own says 0. */
    @Test
    fun noTerminalEndsAMission() {
        for ((width, height) in listOf(0 to 0, 0 to 24, 1 to 1, 2 to 0, 79 to 24)) {
            recorder = TerminalRecorder(width = width, height = height)
            val afloat = Afloat()
            afloat.run.start()
            afloat.meanwhile = { if (afloat.mission.readings.passed > 5) afloat.run.stop() }
            assertEquals(StopReason.OPERATOR, afloat.sail(), "$width x $height")
            if (width == 0) assertContains(recorder.stdout(), "\u001b[K    0.1 s  ")
            directory.resolve("mission.txt.incomplete").toFile().delete()
        }
    }

    private companion object {
        const val MOST_STEPS = 3000
    }
}
