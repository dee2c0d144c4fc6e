package stillwater.app.screen

import android.content.Context
import android.widget.Button
import android.widget.LinearLayout
import stillwater.app.R
import stillwater.app.mission.MissionReport
import stillwater.app.service.BoatSnapshot
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position

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
    private var drawn: List<Any?>? = null

    override val view: LinearLayout =
        context.column().apply {
            below(map, weight = 1f)
            below(context.lowScroll(words, WORDS_SHARE))
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
        val boat = snapshot.mission?.let { boat(it, snapshot) }
        val now = listOf(snapshot.mission, snapshot.headingDeg, boat)
        if (drawn == now) return
        drawn = now
        map.scene = snapshot.mission?.let { scene(it, boat, snapshot.headingDeg) } ?: MapScene()
        if (!map.isTold) words.say(hint(snapshot.mission))
    }

    private fun hint(report: MissionReport?): String {
        val hint = context.getString(if (report == null) R.string.map_begin else R.string.map_hint)
        return listOfNotNull(hint, report?.let { context.givenUpWords(it.givenUp) }).joinToString("\n")
    }

    private fun toggleFollow() {
        map.isFollowing = !map.isFollowing
        follow.isSelected = map.isFollowing
    }

    private fun button(words: Int, said: Int, id: Int, action: () -> Unit): Button =
        context.narrowButton(context.getString(words), action).also {
            it.id = id
            it.contentDescription = context.getString(said)
        }

    private companion object {
        const val ZOOM = 1.6f

        /** Of the screen's height: the map is not to vanish behind what is said of it. */
        const val WORDS_SHARE = 0.2f

        /** Farther from home, the phone is not on this water, and the map would shrink to a dot beside it, m. */
        const val FAR = 1_000.0

        /** Where the boat is; a mission that is over knows no more where its boat was led or drifted. */
        fun boat(report: MissionReport, snapshot: BoatSnapshot): Position? =
            report.position?.takeIf { !report.isOver } ?: atRest(report, snapshot)

        /** Where the phone is, while no mission under way knows its boat; null where nobody knows, or elsewhere. */
        fun atRest(report: MissionReport, snapshot: BoatSnapshot): Position? {
            val fix = snapshot.freshFix ?: return null
            val origin = report.spec.origin
            val place = LocalFrame(LatLon(origin.latitude, origin.longitude)).toLocal(fix.place)
            return place.takeIf { it.distanceTo(report.spec.home.position) < FAR }
        }

        fun scene(report: MissionReport, boat: Position?, headingDeg: Float?): MapScene =
            MapScene(
                map = report.map,
                track = report.track,
                plan = report.plan,
                fence = report.spec.area.corners(),
                keepOuts = report.spec.area.keepOuts.map { ring -> ring.map { it.position } },
                home = report.spec.home.position,
                boat = boat,
                headingDeg = headingDeg,
                unit = report.spec.probe.quantity.unit,
                givenUp = report.givenUp,
                ageOf = report::ageOf,
            )
    }
}
