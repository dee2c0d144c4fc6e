package stillwater.app.setup

import stillwater.app.screen.Background
import stillwater.mission.DraftCheck
import stillwater.mission.MissionDraft

/**
 * The draft that lies open, and what is wrong with it.
 *
 * A long shore takes time to check, so that is done aside; [check] is of the draft before until it is. Confined to the
 * main thread.
 *
 * @param draft to begin with.
 */
internal class DraftDesk(draft: MissionDraft) {
    /** What has been filled in. */
    var draft = draft
        private set

    /** What is wrong with it; null before it was looked at. */
    var check: DraftCheck? = null
        private set

    /** Called whenever [draft] or [check] is another. */
    var onChange: () -> Unit = {}

    init {
        look()
    }

    /** Whether [check] is of [draft] as it is. */
    val isChecked: Boolean get() = checked === draft

    private var checked: MissionDraft? = null

    /** Puts what [change] makes of the draft in its place. */
    fun change(change: (MissionDraft) -> MissionDraft) {
        val next = change(draft)
        if (next == draft) return
        draft = next
        onChange()
        look()
    }

    private fun look() {
        val looked = draft
        Background.run(looked::check) {
            // Meanwhile it may be another, whose own look is under way.
            if (looked === draft) {
                check = it
                checked = looked
                onChange()
            }
        }
    }
}
