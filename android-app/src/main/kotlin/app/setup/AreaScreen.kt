package stillwater.app.setup

import android.content.Context
import android.content.res.Configuration
import android.view.View
import android.view.ViewGroup
import android.widget.Button
import android.widget.LinearLayout
import android.widget.ScrollView
import stillwater.app.R
import stillwater.app.pose.PhoneFix
import stillwater.app.screen.Screen
import stillwater.app.screen.ScreenHost
import stillwater.app.screen.TextField
import stillwater.app.screen.below
import stillwater.app.screen.column
import stillwater.app.screen.heading
import stillwater.app.screen.largeButton
import stillwater.app.screen.liveLine
import stillwater.app.screen.narrowButton
import stillwater.app.screen.row
import stillwater.app.screen.rowIfWide
import stillwater.app.screen.say
import stillwater.app.service.BoatSnapshot
import stillwater.mission.DraftField
import stillwater.mission.MissionDraft
import stillwater.mission.PlaceSpec
import stillwater.model.LatLon
import stillwater.model.Position
import stillwater.model.TypedPlace

/**
 * Draws the water of a mission: corners are dropped where the boat is, touched on the grid or typed as coordinates.
 *
 * @param pen what a touch does at first; [onPen] takes every other, to be kept over a turn of the phone.
 */
internal class AreaScreen(
    private val context: Context,
    private val host: ScreenHost,
    private var pen: AreaPen,
    private val onPen: (AreaPen) -> Unit,
) : Screen {
    private val desk get() = host.desk
    private val water =
        AreaView(context, onPlace = ::place, onCorner = { take(pen.taking(it)) }).apply { id = R.id.area }
    private val summary = context.liveLine()
    private val problem = context.liveLine().apply { setTextColor(context.getColor(R.color.bad)) }
    private val drop = button(R.string.drop_corner, R.id.drop_corner, ::dropHere)
    private val remove = button(R.string.undo_corner, R.id.undo_corner) { change { pen.remove(it) } }
    private val shore = button(R.string.draw_shore, R.id.draw_shore) { take(AreaPen()) }
    private val keepOut = button(R.string.draw_keep_out, R.id.draw_keep_out) { take(pen.newKeepOut(desk.draft)) }
    private val home = button(R.string.draw_home, R.id.draw_home) { take(AreaPen(PenTarget.HOME)) }
    private val polygon = button(R.string.polygon, R.id.polygon) { shape(false) }
    private val rectangle = button(R.string.rectangle, R.id.rectangle) { shape(true) }
    private val latitude = TextField(context, context.getString(R.string.latitude), isNumber = true) { typed() }
    private val longitude = TextField(context, context.getString(R.string.longitude), isNumber = true) { typed() }
    private var fix: PhoneFix? = null

    /** [fix], while the phone is still there. */
    private var fresh: PhoneFix? = null

    /** Why the last place was not added; null where it was. */
    private var refusal: String? = null

    override val view: View = laidOut()

    override fun opened() = refresh()

    override fun show(snapshot: BoatSnapshot) {
        fix = snapshot.fix
        fresh = snapshot.freshFix
        refresh()
    }

    private fun laidOut(): View {
        val isWide = context.resources.configuration.orientation == Configuration.ORIENTATION_LANDSCAPE
        val share = if (isWide) LYING_SHARE else 1f
        val controls =
            context.column().apply {
                val gap = resources.getDimensionPixelSize(R.dimen.gap)
                setPadding(gap, 0, gap, gap)
                below(summary)
                below(problem)
                below(context.rowIfWide(drop, remove, share = share))
                below(context.rowIfWide(shore, keepOut, home, share = share))
                below(
                    context.row(
                        zoomButton(R.string.zoom_out, R.string.zoom_out_said) { water.zoom(1 / ZOOM) },
                        zoomButton(R.string.zoom_in, R.string.zoom_in_said) { water.zoom(ZOOM) },
                        zoomButton(R.string.show_all, R.string.show_all_said) { water.showAll() },
                    ),
                )
                below(context.rowIfWide(polygon, rectangle, share = share))
                below(context.heading(context.getString(R.string.coordinates)))
                below(latitude)
                below(longitude)
                below(button(R.string.add_coordinates, R.id.add_coordinates, ::addTyped))
                below(button(R.string.clear_area, R.id.clear_area, ::clear))
                below(button(R.string.area_done, R.id.area_done) { host.back() })
            }
        val scroll = ScrollView(context).apply { addView(controls) }
        return LinearLayout(context).apply {
            orientation = if (isWide) LinearLayout.HORIZONTAL else LinearLayout.VERTICAL
            addView(water, share(isWide, WATER_SHARE))
            addView(scroll, share(isWide, CONTROLS_SHARE))
        }
    }

    private fun share(isWide: Boolean, weight: Float): LinearLayout.LayoutParams {
        val all = ViewGroup.LayoutParams.MATCH_PARENT
        return if (isWide) LinearLayout.LayoutParams(0, all, weight) else LinearLayout.LayoutParams(all, 0, weight)
    }

    private fun button(words: Int, id: Int, action: () -> Unit): Button =
        context.largeButton(context.getString(words), action).also { it.id = id }

    private fun zoomButton(words: Int, said: Int, action: () -> Unit): Button =
        context.narrowButton(context.getString(words), action).also { it.contentDescription = context.getString(said) }

    /** The draft's frame begins where the phone is, unless something has been drawn. */
    private fun refresh() {
        fix?.let { framed(desk.draft, it.place) }?.let { framed -> if (framed != desk.draft) desk.change { framed } }
        val draft = desk.draft
        val here = fresh?.let { draft.frame()?.toLocal(it.place) }
        water.show(draft, pen, desk.check?.grid, here, fresh?.accuracyMetres ?: 0f)
        drop.isEnabled = fresh != null
        drop.say(
            fresh?.let { context.getString(R.string.drop_corner_within, it.accuracyMetres ?: Float.NaN) }
                ?: context.getString(R.string.drop_corner_no_fix),
        )
        remove.say(context.getString(if (pen.selected == null) R.string.undo_corner else R.string.remove_corner))
        shore.isSelected = pen.target == PenTarget.SHORE
        keepOut.isSelected = pen.target == PenTarget.KEEP_OUT
        home.isSelected = pen.target == PenTarget.HOME
        polygon.isSelected = !draft.isRectangle
        rectangle.isSelected = draft.isRectangle
        if (!desk.isChecked) return
        val check = desk.check ?: return
        summary.say(
            context.areaSummary(draft, check),
        )
        val wrong = listOf(DraftField.AREA, DraftField.HOME, DraftField.CELL).mapNotNull { check.problems[it] }
        problem.say((refusal ?: wrong.firstOrNull())?.let { context.getString(R.string.problem, it) })
    }

    private fun take(pen: AreaPen) {
        this.pen = pen
        refusal = null
        onPen(pen)
        refresh()
    }

    private fun change(change: (MissionDraft) -> MissionDraft) {
        desk.change(change)
        take(pen.copy(selected = null))
    }

    private fun place(position: Position) {
        // A touch beside a selected corner lets go of it first: nothing is added by mistake.
        if (pen.selected != null) return take(pen.copy(selected = null))
        add(desk.draft, position)
    }

    private fun dropHere() {
        fresh?.let { add(it.place) }
    }

    private fun add(place: LatLon) {
        val framed = framed(desk.draft, place)
        framed.frame()?.let { add(framed, it.toLocal(place)) }
    }

    /** [draft], which begins at [place] where nothing is drawn yet and it began at another water, or nowhere. */
    private fun framed(draft: MissionDraft, place: LatLon): MissionDraft {
        if (draft.shore.isNotEmpty() || draft.keepOuts.isNotEmpty() || draft.home != null) return draft
        val old = draft.frame()?.toLocal(place)
        // Not with every breath of the receiver.
        return if (old != null && old.distanceTo(ORIGIN) <= FAR) draft else draft.copy(origin = null).around(place)
    }

    /** Adds [position] to [draft], unless it is of quite another water: a slip of the sign, or last week's draft. */
    private fun add(draft: MissionDraft, position: Position) {
        if (PlaceSpec.reaches(position)) return change { pen.add(draft, position) }
        refusal = context.getString(R.string.far_place, position.distanceTo(ORIGIN) / METRES_PER_KM)
        refresh()
    }

    private fun shape(isRectangle: Boolean) = change { it.copy(isRectangle = isRectangle) }

    private fun typed() {
        latitude.problem(null)
        longitude.problem(null)
    }

    private fun addTyped() {
        val (north, east) = listOf(latitude, longitude).map { it.edit.text.toString() }
        val typed = TypedPlace.of(north, east)
        latitude.problem(context.getString(R.string.bad_latitude, north).takeIf { typed.latitudeDeg == null })
        longitude.problem(context.getString(R.string.bad_longitude, east).takeIf { typed.longitudeDeg == null })
        add(typed.place ?: return)
        if (refusal != null) return
        latitude.fill("")
        longitude.fill("")
    }

    private fun clear() {
        desk.change { it.copy(shore = emptyList(), keepOuts = emptyList(), home = null) }
        take(AreaPen())
        water.showAll()
    }

    private companion object {
        const val WATER_SHARE = 3f

        /** Of a lying phone's width that the controls have, beside the water and the window's frame. */
        const val LYING_SHARE = 0.28f
        const val CONTROLS_SHARE = 2f
        const val ZOOM = 1.6f

        /** Where a frame that nothing is drawn in begins anew, m. */
        const val FAR = 1_000.0
        const val METRES_PER_KM = 1_000.0
        val ORIGIN = Position(0.0, 0.0)
    }
}
