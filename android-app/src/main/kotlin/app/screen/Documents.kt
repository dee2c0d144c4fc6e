package stillwater.app.screen

import android.content.Context
import android.content.Intent
import android.net.Uri
import android.os.Bundle
import android.provider.DocumentsContract
import stillwater.app.R
import stillwater.app.mayWait
import stillwater.app.mission.LogFolder
import stillwater.app.service.BoatService
import stillwater.app.setup.DraftDesk
import stillwater.mission.CellsText
import stillwater.mission.MissionDraft
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionSpec
import java.io.ByteArrayOutputStream
import java.io.File
import java.io.IOException
import java.io.InputStream
import java.io.OutputStream

/**
 * Reads and writes the documents that a person chose, aside from the main thread, and tells what came of it.
 *
 * A document that could not be written whole is removed again.
 *
 * @param tell takes words for the person.
 */
internal class Documents(
    context: Context,
    private val desk: DraftDesk,
    private val tell: (String, DocumentPurpose) -> Unit,
) {
    private val context = context.applicationContext

    /** The name of the log that is to be shared; survives the process, for choosing a place may take long. */
    private var shared: String? = null

    /** Keeps what is under way in [state]. */
    fun save(state: Bundle) = state.putString(SHARED, shared)

    /** Takes up what [state] has under way. */
    fun restore(state: Bundle?) {
        shared = state?.getString(SHARED)
    }

    /** Asks, through [host], where [log] is to be written as what [purpose] says. */
    fun share(log: String, purpose: DocumentPurpose, host: ScreenHost) {
        shared = log
        val (type, extension) =
            when (purpose) {
                DocumentPurpose.CSV -> "text/csv" to "csv"
                DocumentPurpose.GEOJSON -> "application/geo+json" to "geojson"
                else -> "text/plain" to "txt"
            }
        val title = "${log.substringBefore('.')}.$extension"
        host.choose(
            Intent(Intent.ACTION_CREATE_DOCUMENT)
                .addCategory(Intent.CATEGORY_OPENABLE)
                .setType(type)
                .putExtra(Intent.EXTRA_TITLE, title),
            purpose,
        )
    }

    /** The person chose [document] for [purpose]; null where they thought better of it. */
    fun chosen(purpose: DocumentPurpose, document: Uri?) {
        if (document == null) return tell(context.getString(R.string.document_cancelled), purpose)
        when (purpose) {
            DocumentPurpose.MISSION ->
                read(document, purpose) { json, _ -> MissionDraft.of(MissionSpec.fromJson(json)) }
            DocumentPurpose.PROBE -> read(document, purpose) { json, draft -> draft.measuring(json) }
            DocumentPurpose.SAVED_MISSION -> {
                // Not the desk's last look at it: after a turn of the phone there is none yet.
                val draft = desk.draft
                write(document, purpose) {
                    mayWait("write a document")
                    val spec = draft.check().spec ?: throw IOException(context.getString(R.string.save_not_whole))
                    it.write(spec.toJson().toByteArray())
                }
            }
            DocumentPurpose.LOG -> ofShared(document, purpose, ::copy)
            DocumentPurpose.CSV -> ofShared(document, purpose) { log, out -> cells(log, out) { csv(it) } }
            DocumentPurpose.GEOJSON -> ofShared(document, purpose) { log, out -> cells(log, out) { geoJson(it) } }
        }
    }

    private fun read(document: Uri, purpose: DocumentPurpose, take: (String, MissionDraft) -> MissionDraft) {
        val before = desk.draft
        Background.run({
            attempt {
                val stream = context.contentResolver.openInputStream(document) ?: throw nothingThere()
                val text = stream.use { String(it.readLimited(), Charsets.UTF_8) }
                take(text, before)
            }
        }) { outcome ->
            outcome.onSuccess { taken -> desk.change { taken } }
            tell(
                outcome.fold(
                    { context.getString(R.string.document_read) },
                    { context.getString(R.string.document_not_read, it.message ?: it.javaClass.simpleName) },
                ),
                purpose,
            )
        }
    }

    private fun ofShared(document: Uri, purpose: DocumentPurpose, write: (File, OutputStream) -> Unit) {
        val log = shared ?: return tell(context.getString(R.string.document_cancelled), purpose)
        shared = null
        write(document, purpose) {
            // The mission may have ended, and its log been closed, while the person chose a place.
            val open = BoatService.logOf(context, log)
            write(if (open.exists()) open else BoatService.logOf(context, log.removeSuffix(LogFolder.INCOMPLETE)), it)
        }
    }

    private fun write(document: Uri, purpose: DocumentPurpose, write: (OutputStream) -> Unit) {
        tell(context.getString(R.string.document_writing), purpose)
        Background.run({
            attempt {
                val stream =
                    context.contentResolver.openOutputStream(document, "wt") ?: throw nothingThere()
                stream.use(write)
            }.onFailure { remove(document) }
        }) { outcome ->
            tell(
                outcome.fold(
                    { context.getString(R.string.document_written) },
                    { context.getString(R.string.document_not_written, it.message ?: it.javaClass.simpleName) },
                ),
                purpose,
            )
        }
    }

    private fun copy(log: File, out: OutputStream) {
        mayWait("read a log")
        log.inputStream().use { it.copyTo(out) }
    }

    /** The map as the log has it, for what [form] makes of it. */
    private fun cells(log: File, out: OutputStream, form: CellsText.(Appendable) -> Unit) {
        mayWait("read a log")
        val recovery = MissionRecovery()
        log.useLines { lines -> lines.forEach(recovery::line) }
        val mission = recovery.recovered() ?: throw IOException(context.getString(R.string.log_without_mission))
        val writer = out.bufferedWriter()
        CellsText(mission.spec, mission.estimator.map).form(writer)
        writer.flush()
    }

    private fun remove(document: Uri) {
        // Some places do not let it; what is there then is empty or cut, and the person is told either way.
        attempt { DocumentsContract.deleteDocument(context.contentResolver, document) }
    }

    /** What [work] gives, or what another app's documents, the disk or the text had against it. */
    private fun <T> attempt(work: () -> T): Result<T> =
        try {
            mayWait("a document")
            Result.success(work())
        } catch (e: IOException) {
            Result.failure(e)
        } catch (@Suppress("TooGenericExceptionCaught") e: RuntimeException) {
            // Whatever another app's documents throw comes back here, and is no reason to end the process that steers the boat.
            Result.failure(e)
        }

    private fun nothingThere() = IOException(context.getString(R.string.document_nothing_there))

    private fun InputStream.readLimited(): ByteArray {
        val all = ByteArrayOutputStream()
        val piece = ByteArray(PIECE)
        while (true) {
            val size = read(piece)
            if (size < 0) return all.toByteArray()
            all.write(piece, 0, size)
            if (all.size() > LARGEST) throw IOException(context.getString(R.string.document_too_large))
        }
    }

    private companion object {
        const val SHARED = "shared-log"
        const val PIECE = 8192

        /** The largest area has 20,000 corners, of 60 bytes or so each. */
        const val LARGEST = 8 * 1024 * 1024
    }
}
