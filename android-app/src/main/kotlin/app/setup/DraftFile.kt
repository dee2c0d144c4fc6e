package stillwater.app.setup

import android.content.Context
import stillwater.app.mayWait
import stillwater.app.screen.Background
import stillwater.mission.MissionDraft
import java.io.File
import java.io.IOException

/** Keeps the draft over the app's end: half a shore that was walked is not to be walked again. */
internal class DraftFile(context: Context) {
    private val context = context.applicationContext
    private val file: File by lazy {
        mayWait("the app's folder")
        File(this.context.filesDir, "draft.json")
    }

    /** Hands over what was kept, if anything was. */
    fun read(then: (MissionDraft) -> Unit) =
        Background.run({
            try {
                mayWait("read the draft")
                file.takeIf { it.isFile }?.readText()?.let(MissionDraft::fromJson)
            } catch (_: IOException) {
                // As if nothing had been kept: the person sees an empty form.
                null
            }
        }) { it?.let(then) }

    /** Keeps [draft]; the one before stays until this one is whole. */
    fun write(draft: MissionDraft) =
        Background.run({
            try {
                mayWait("write the draft")
                val next = File(file.path + ".new")
                next.writeText(draft.toJson())
                next.renameTo(file)
            } catch (_: IOException) {
                // Full storage: the checklist says so, and Android's own state still has the draft.
                false
            }
        }) { }
}
