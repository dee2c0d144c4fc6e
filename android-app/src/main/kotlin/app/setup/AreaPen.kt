package stillwater.app.setup

import stillwater.mission.MissionDraft
import stillwater.mission.PlaceSpec
import stillwater.model.Position

/** A corner that is already there: of the shore where [ring] is -1, else of that keep-out. */
internal data class Corner(val ring: Int, val index: Int)

/** What the next place becomes. */
internal enum class PenTarget { SHORE, KEEP_OUT, HOME }

/**
 * What a touch of the water does to a draft.
 *
 * @property target what the next place becomes.
 * @property ring keep-out that it is added to; one beyond the last begins a new one.
 * @property selected corner that was touched, which may be taken away; null where none is.
 */
internal data class AreaPen(
    val target: PenTarget = PenTarget.SHORE,
    val ring: Int = 0,
    val selected: Corner? = null,
) {
    /** Begins a keep-out of its own in [draft]. */
    fun newKeepOut(draft: MissionDraft) = AreaPen(PenTarget.KEEP_OUT, draft.keepOuts.size)

    /** Goes on with the outline that [corner] is of. */
    fun taking(corner: Corner) =
        if (corner.ring < 0) {
            AreaPen(PenTarget.SHORE, selected = corner)
        } else {
            AreaPen(PenTarget.KEEP_OUT, corner.ring, corner)
        }

    /** [draft] with one more place. */
    fun add(draft: MissionDraft, position: Position): MissionDraft {
        val place = draft.place(position)
        return when (target) {
            PenTarget.HOME -> draft.copy(home = place)
            PenTarget.KEEP_OUT ->
                if (ring >= draft.keepOuts.size) {
                    draft.copy(keepOuts = draft.keepOuts.plusElement(listOf(place)))
                } else {
                    draft.withRing(ring, draft.keepOuts[ring] + place)
                }
            // A rectangle's third corner is its second, set better.
            PenTarget.SHORE ->
                draft.copy(shore = (if (draft.isRectangle) draft.shore.take(1) else draft.shore) + place)
        }
    }

    /** [draft] without the corner that is selected, or else without the place that was added last. */
    fun remove(draft: MissionDraft): MissionDraft {
        val selected = this.selected
        return when {
            selected != null && selected.ring < 0 -> draft.copy(shore = draft.shore.without(selected.index))
            selected != null -> draft.withRing(selected.ring, draft.ring(selected.ring).without(selected.index))
            target == PenTarget.HOME -> draft.copy(home = null)
            target == PenTarget.SHORE -> draft.copy(shore = draft.shore.dropLast(1))
            else -> draft.withRing(ring, draft.ring(ring).dropLast(1))
        }
    }

    /** The corner of [draft] that is nearest to [position] and at most [reach] m off; null where none is. */
    fun cornerNear(draft: MissionDraft, position: Position, reach: Double): Corner? =
        (listOf(draft.shore) + draft.keepOuts)
            .flatMapIndexed { ring, places -> places.indices.map { Corner(ring - 1, it) to places[it] } }
            .map { (corner, place) -> corner to position.distanceTo(Position(place.x, place.y)) }
            .filter { it.second <= reach }
            .minByOrNull { it.second }
            ?.first

    private fun MissionDraft.ring(index: Int) = keepOuts.getOrElse(index) { emptyList() }

    /** An outline that lost its last corner is none. */
    private fun MissionDraft.withRing(index: Int, places: List<PlaceSpec>) =
        copy(
            keepOuts =
            keepOuts.mapIndexed { each, old -> if (each == index) places else old }.filter { it.isNotEmpty() },
        )

    private fun List<PlaceSpec>.without(index: Int) = filterIndexed { each, _ -> each != index }
}
