package stillwater.app.screen

import android.content.Context
import android.widget.Button
import android.widget.LinearLayout
import stillwater.app.R
import stillwater.app.mission.MissionReport
import stillwater.app.service.BoatSnapshot

/** The live map, what is known of the cell that was touched, and how near it is seen. */
internal class MapScreen(private val context: Context) : Screen {
    private val map = MapView(context).apply { id = R.id.map }
    private val words =
        // Not a live region: a cell's age grows all the time. What a finger touches the map says itself.
        context.line(context.getString(R.string.map_begin)).apply {
            id = R.id.map_words
            val gap = resources.getDimensionPixelSize(R.dimen.gap)
            setPadding(gap, gap / 3, gap, gap / 3)
        }
    private val follow = button(R.string.follow, R.string.follow_said, R.id.follow) { toggleFollow() }
    private var drawn: Pair<MissionReport?, Float?>? = null

    override val view: LinearLayout =
        context.column().apply {
            below(map, weight = 1f)
            below(words)
            below(
                context.row(
                    button(R.string.zoom_out, R.string.zoom_out_said, R.id.zoom_out) { map.zoom(1 / ZOOM) },
                    button(R.string.zoom_in, R.string.zoom_in_said, R.id.zoom_in) { map.zoom(ZOOM) },
                    button(R.string.show_all, R.string.show_all_said, R.id.show_all) {
                        map.showAll()
                        follow.isSelected = false
                    },
                    follow,
                ),
            )
        }

    init {
        map.onCell = { words.say(it) }
        map.onMoved = { follow.isSelected = map.isFollowing }
    }

    override fun opened() {
        follow.isSelected = map.isFollowing
    }

    override fun show(snapshot: BoatSnapshot) {
        // The same report twice is drawn once.
        val now = snapshot.mission to snapshot.headingDeg
        if (drawn?.first === now.first && drawn?.second == now.second) return
        drawn = now
        map.scene = snapshot.mission?.let { scene(it, snapshot.headingDeg) } ?: MapScene()
        if (!map.isTold) {
            words.say(context.getString(if (snapshot.mission == null) R.string.map_begin else R.string.map_hint))
        }
    }

    private fun toggleFollow() {
        map.isFollowing = !map.isFollowing
        follow.isSelected = map.isFollowing
    }

    private fun button(words: Int, said: Int, id: Int, action: () -> Unit): Button =
        context.largeButton(context.getString(words), action).also {
            it.id = id
            it.contentDescription = context.getString(said)
        }

    private companion object {
        const val ZOOM = 1.6f

        fun scene(report: MissionReport, headingDeg: Float?): MapScene =
            MapScene(
                map = report.map,
                track = report.track,
                plan = report.plan,
                fence = report.spec.area.corners(),
                keepOuts = report.spec.area.keepOuts.map { ring -> ring.map { it.position } },
                home = report.spec.home.position,
                boat = report.position,
                headingDeg = headingDeg,
                unit = report.spec.probe.quantity.unit,
                ageOf = report::ageOf,
            )
    }
}
