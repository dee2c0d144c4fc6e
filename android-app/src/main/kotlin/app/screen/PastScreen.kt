package stillwater.app.screen

import android.content.Context
import android.text.format.DateUtils
import android.text.format.Formatter
import android.view.View
import android.widget.Button
import android.widget.LinearLayout
import stillwater.app.R
import stillwater.app.mayWait
import stillwater.app.mission.LogFolder
import stillwater.app.mission.PastMission
import stillwater.app.service.BoatService
import stillwater.app.service.BoatSnapshot

/** The missions that were: each can be shared, closed where it was cut off, and deleted after a question. */
internal class PastScreen(
    private val context: Context,
    private val host: ScreenHost,
    private val documents: Documents,
) : Screen {
    private val said = context.liveLine().apply { id = R.id.shared_said }
    private val empty = context.line(context.getString(R.string.past_looking))
    private val list = context.column().apply { id = R.id.past_list }
    private val files = context.applicationContext
    private var shown: List<PastMission>? = null
    private var shownOpen: String? = null

    /** What a person has opened, and whether they have pressed delete there. */
    private var opened: String? = null
    private var asksDeletion = false

    override val view: View =
        context.scrolling {
            below(said)
            below(empty)
            below(list)
        }

    override fun opened() {
        host.boat?.lookForPast()
    }

    override fun show(snapshot: BoatSnapshot) {
        val past = snapshot.past
        if (past == null) host.boat?.lookForPast()
        val open = snapshot.mission?.log?.takeIf { !it.isClosed }?.name
        if (past == shown && open == shownOpen) return
        shown = past
        shownOpen = open
        fill()
    }

    /** Tells what became of a document. */
    fun say(words: String?) = said.say(words)

    private fun fill() {
        val past = shown
        empty.say(
            when {
                past == null -> context.getString(R.string.past_looking)
                past.isEmpty() -> context.getString(R.string.past_none)
                else -> null
            },
        )
        list.removeAllViews()
        for (mission in past.orEmpty()) {
            val button = context.largeButton(titled(mission)) { toggle(mission.name) }
            button.isSelected = mission.name == opened
            list.below(button)
            if (mission.name == opened) list.below(actions(mission))
        }
    }

    private fun toggle(name: String) {
        opened = name.takeIf { it != opened }
        asksDeletion = false
        fill()
    }

    private fun titled(mission: PastMission): String {
        val flags = DateUtils.FORMAT_SHOW_DATE or DateUtils.FORMAT_SHOW_TIME or DateUtils.FORMAT_ABBREV_ALL
        val date = DateUtils.formatDateTime(context, mission.epochMillis, flags)
        val size = Formatter.formatShortFileSize(context, mission.bytes)
        val state =
            when {
                mission.name == shownOpen -> R.string.past_under_way
                mission.isComplete -> R.string.past_complete
                else -> R.string.past_incomplete
            }
        val name = mission.name.substringBefore('.').let { if (it.length > STAMP) it.drop(STAMP) else it }
        return context.getString(R.string.past_title, name, date, size, context.getString(state))
    }

    private fun actions(mission: PastMission): LinearLayout =
        context.column().apply {
            below(context.line(context.getString(R.string.share)))
            below(
                context.rowIfWide(
                    sharing(mission, R.string.share_log, R.string.share_log_said, DocumentPurpose.LOG),
                    sharing(mission, R.string.share_csv, R.string.share_csv_said, DocumentPurpose.CSV),
                    sharing(mission, R.string.share_geojson, R.string.share_geojson_said, DocumentPurpose.GEOJSON),
                ),
            )
            // What is being written is nobody else's to close or to take away.
            if (mission.name == shownOpen) return@apply
            if (!mission.isComplete) {
                below(context.line(context.getString(R.string.past_incomplete_why)))
                val goOn = context.largeButton(context.getString(R.string.go_on_with)) { goOn(mission) }
                below(goOn.apply { id = R.id.go_on_with })
                below(context.largeButton(context.getString(R.string.close_log)) { close(mission) })
            }
            if (asksDeletion) {
                // Where the question was asked for: a second tap of the same hand keeps it.
                val no = context.largeButton(context.getString(R.string.delete_no)) { ask(false) }
                below(no.apply { id = R.id.delete_no })
                below(context.liveLine(context.getString(R.string.delete_sure)))
                val yes = context.largeButton(context.getString(R.string.delete_yes)) { delete(mission) }
                below(yes.apply { id = R.id.delete_yes })
            } else {
                below(context.largeButton(context.getString(R.string.delete)) { ask(true) }.apply { id = R.id.delete })
            }
        }

    private fun sharing(mission: PastMission, words: Int, spoken: Int, purpose: DocumentPurpose): Button =
        context.largeButton(context.getString(words)) {
            documents.share(mission.name, purpose, host)
        }.also { it.contentDescription = context.getString(spoken) }

    private fun ask(asks: Boolean) {
        asksDeletion = asks
        fill()
    }

    /** Its map and its state come to the screen with the controls; so does why not. */
    private fun goOn(mission: PastMission) {
        host.boat?.goOnWith(mission.name)
        host.open(ScreenName.START)
    }

    private fun close(mission: PastMission) {
        val complete = mission.name.removeSuffix(LogFolder.INCOMPLETE)
        onDisk(R.string.closed_log, R.string.not_closed_log) {
            BoatService.logOf(files, mission.name).renameTo(BoatService.logOf(files, complete))
        }
    }

    private fun delete(mission: PastMission) {
        asksDeletion = false
        onDisk(R.string.deleted, R.string.not_deleted) { BoatService.logOf(files, mission.name).delete() }
    }

    private fun onDisk(done: Int, notDone: Int, work: () -> Boolean) =
        Background.run({
            mayWait("a log's folder")
            work()
        }) { isDone ->
            say(context.getString(if (isDone) done else notDone))
            host.boat?.lookForPast()
        }

    private companion object {
        /** A log's name begins with when it was begun, 2026-07-14T09-31-12-. */
        const val STAMP = 20
    }
}
