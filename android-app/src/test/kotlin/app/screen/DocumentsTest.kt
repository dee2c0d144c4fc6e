package stillwater.app.screen

import android.app.Activity
import android.app.Application
import android.content.Intent
import android.net.Uri
import android.view.View
import android.widget.Button
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import stillwater.app.R
import stillwater.app.mission.PastMission
import stillwater.app.service.BoatService
import stillwater.mission.LogStart
import stillwater.mission.MissionDraft
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.ReadingVerdict
import stillwater.model.BoatTime
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.wire.Message
import java.io.ByteArrayOutputStream
import java.io.File
import java.io.IOException
import java.io.OutputStream
import java.util.concurrent.Executor
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
class DocumentsTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val document = Uri.parse("content://cards/7")
    private val out = ByteArrayOutputStream()
    private val log = writeLog()
    private val window = Window()
    private val activity get() = window.activity

    /** Two readings of one cell; the end is cut off, as by an empty battery. */
    private fun writeLog(): File {
        val lines = ArrayList<String>()
        val writer = MissionLog(lines::add, LogStart(1_784_000_000_000, "2026-07-14 03:33:20"), Scenes.spec)
        for (second in 1..2) {
            val now = BoatTime(second.toDouble())
            val reading = Reading(now, Position(7.0, 8.0), 8.0 + second)
            writer.reading(now, Message.Oxygen(1, reading.value), ReadingVerdict.PASSED, listOf(reading), null)
        }
        return BoatService.logOf(context, NAME).apply {
            parentFile?.mkdirs()
            writeText(lines.joinToString("\n", postfix = "\n2100\tI\t{\"mission\":{\"t_s\""))
        }
    }

    private fun openPast() {
        activity.go(ScreenName.PAST)
        val past = listOf(PastMission(NAME, log.length(), isComplete = false, epochMillis = 1_784_000_000_000))
        window.boat.snapshot = Scenes.standingBy.copy(past = past)
        activity.show(window.boat.snapshot)
        activity.shown().filterIsInstance<Button>().single { "CUT\u00A0OFF" in it.text }.performClick()
    }

    /** Presses [words] and answers Android's question with [answer]; null is a change of mind. */
    private fun choose(words: String, answer: Uri?): Intent {
        activity.button(words).performClick()
        val asked = shadowOf(activity).nextStartedActivityForResult.intent
        val result = if (answer == null) Activity.RESULT_CANCELED else Activity.RESULT_OK
        shadowOf(activity).receiveResult(asked, result, answer?.let { Intent().setData(it) })
        window.settle()
        return asked
    }

    private fun take(stream: OutputStream = out) =
        shadowOf(context.contentResolver).registerOutputStream(document, stream)

    @Test
    fun theLogIsSharedByteForByte() {
        take()
        openPast()
        val asked = choose("Log", document)
        assertEquals(Intent.ACTION_CREATE_DOCUMENT, asked.action)
        assertEquals("2026-07-13T15-02-05-Mill-bay.txt", asked.getStringExtra(Intent.EXTRA_TITLE))
        assertContentEquals(log.readBytes(), out.toByteArray())
        assertTrue("Written" in activity.wordsShown())
    }

    @Test
    fun theMapIsSharedAsTablesAndShapesEvenOfALogThatWasCutOff() {
        take()
        openPast()
        choose("CSV", document)
        val table = out.toString().trimEnd().lines().map { it.split(',') }
        assertEquals(Scenes.spec.grid.grid().size + 1, table.size)
        assertEquals(1, table.drop(1).count { it[table[0].indexOf("readings")] == "2" })
        out.reset()
        assertEquals("application/geo+json", choose("GeoJSON", document).type)
        val shapes = Json.parseToJsonElement(out.toString()).jsonObject
        val feature = shapes.getValue("features").jsonArray.single().jsonObject
        assertEquals("mg/L", feature.getValue("properties").jsonObject.getValue("unit").jsonPrimitive.content)
        // Longitude first, as the standard has it and no map says: the other way round lies in Antarctica.
        val ring = feature.getValue("geometry").jsonObject.getValue("coordinates").jsonArray.single().jsonArray
        for ((longitude, latitude) in ring.map { at -> at.jsonArray.map { it.jsonPrimitive.double } }) {
            assertEquals(Scenes.spec.origin.longitude, longitude, 0.01)
            assertEquals(Scenes.spec.origin.latitude, latitude, 0.01)
        }
    }

    /** A log of a long day goes through a small buffer, and its map through the reader line by line. */
    @Test
    fun aLargeLogIsSharedInSmallPieces() {
        val body = log.readText().lines()
        log.bufferedWriter().use { writer ->
            body.dropLast(1).forEach { writer.appendLine(it) }
            repeat(LARGE / FILLING.length) { writer.appendLine(FILLING) }
        }
        var (whole, largest) = 0L to 0
        take(
            object : OutputStream() {
                override fun write(b: Int) = write(byteArrayOf(b.toByte()), 0, 1)

                override fun write(bytes: ByteArray, from: Int, count: Int) {
                    whole += count
                    largest = maxOf(largest, count)
                }
            },
        )
        openPast()
        choose("Log", document)
        assertEquals(log.length(), whole)
        assertTrue(largest <= LARGE / 100, "$largest bytes at once, of $whole")
    }

    @Test
    fun aChangeOfMindWritesNothing() {
        take()
        openPast()
        choose("GeoJSON", null)
        assertEquals(0, out.size())
        assertTrue("Nothing was chosen" in activity.wordsShown())
    }

    @Test
    fun aPlaceThatTakesNothingIsSaidSo() {
        val full =
            object : OutputStream() {
                override fun write(b: Int): Unit = throw IOException("ENOSPC")
            }
        take(full)
        openPast()
        choose("CSV", document)
        assertTrue("Not written: ENOSPC" in activity.wordsShown(), "${activity.wordsShown()}")
    }

    /** Any exception of another app's provider comes back to its caller. */
    @Test
    fun aProviderThatFailsInAnyWayDoesNotEndTheProcess() {
        val broken =
            object : OutputStream() {
                override fun write(b: Int): Unit = error("its account is gone")
            }
        take(broken)
        openPast()
        choose("CSV", document)
        assertTrue("Not written: its account is gone" in activity.wordsShown(), "${activity.wordsShown()}")
    }

    @Test
    fun whatIsChosenIsWrittenEvenWhenTheProcessDiedMeanwhile() {
        take()
        openPast()
        activity.button("Log").performClick()
        val asked = shadowOf(activity).nextStartedActivityForResult.intent
        window.controller.recreate()
        activity.go(ScreenName.PAST)
        @Suppress("DEPRECATION")
        activity.onActivityResult(DocumentPurpose.LOG.ordinal, Activity.RESULT_OK, Intent(asked).setData(document))
        window.settle()
        assertContentEquals(log.readBytes(), out.toByteArray())
    }

    @Test
    fun deletionAsksAndWhatWasCutOffCanBeClosed() {
        openPast()
        activity.view<View>(R.id.delete).performClick()
        assertTrue("Delete the log and all that was measured?" in activity.wordsShown())
        activity.button("Keep it").performClick()
        assertTrue(log.isFile)
        activity.button("Mark as finished").performClick()
        window.settle()
        val closed = BoatService.logOf(context, NAME.removeSuffix(".incomplete"))
        assertTrue(closed.isFile && !log.isFile)
        closed.renameTo(log)
        activity.view<View>(R.id.delete).performClick()
        activity.view<View>(R.id.delete_yes).performClick()
        window.settle()
        assertFalse(log.exists())
        assertTrue("Deleted" in activity.wordsShown())
        assertEquals("look", window.boat.told.last())
    }

    @Test
    fun nothingTouchesADocumentOrALogOnTheMainThread() {
        val waiting = ArrayDeque<Runnable>()
        take()
        openPast()
        Background.executor = Executor { waiting += it }
        choose("CSV", document)
        activity.view<View>(R.id.delete).performClick()
        activity.view<View>(R.id.delete_yes).performClick()
        window.settle()
        assertEquals(0, out.size())
        assertTrue(log.isFile)
        while (waiting.isNotEmpty()) waiting.removeFirst().run()
        assertTrue(out.size() > 0 && !log.exists())
    }

    @Test
    fun whatIsBeingWrittenCanNeitherBeClosedNorDeleted() {
        activity.go(ScreenName.PAST)
        val open = checkNotNull(Scenes.report.log).name
        activity.show(Scenes.surveying.copy(past = listOf(PastMission(open, 9, false, 0))))
        activity.shown().filterIsInstance<Button>().single { "in use" in it.text }.performClick()
        val words = activity.wordsShown()
        assertTrue("Log" in words)
        assertTrue("Delete" !in words && "Mark as finished" !in words, "$words")
    }

    @Test
    fun aMissionIsReadAndWrittenAndWhatIsNoneIsRefusedInOneLine() {
        activity.go(ScreenName.MISSION)
        give(Scenes.spec.toJson())
        choose("Load a file", document)
        assertEquals(Scenes.spec, activity.desk.check?.spec)
        take()
        choose("Save a file", document)
        assertEquals(Scenes.spec, MissionSpec.fromJson(out.toString()))
        val before: MissionDraft = activity.desk.draft
        give("{\"name\":\"x\"")
        choose("Load a file", document)
        assertTrue(activity.wordsShown().any { it.startsWith("Not read: not a mission: ") && '\n' !in it })
        assertEquals(before, activity.desk.draft)
        give("""{"quantity":"temperature","lowest":4,"highest":30}""")
        choose("Load a probe or sensor file", document)
        assertEquals(30.0, activity.desk.check?.spec?.probe?.highest)
        choose("Load a file", null)
        assertTrue("Nothing was chosen" in activity.wordsShown())
    }

    private fun give(text: String) =
        shadowOf(context.contentResolver).registerInputStream(document, text.byteInputStream())

    private companion object {
        const val LARGE = 4_000_000
        const val FILLING = "2000\tI\t{\"sensor\":{\"channel\":1,\"type\":\"BATTERY\",\"data\":15.2}}"
        const val NAME = "2026-07-13T15-02-05-Mill-bay.log.incomplete"
    }
}
