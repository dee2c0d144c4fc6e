package stillwater.diagnose.blind

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.all
import stillwater.diagnose.track.SmoothTrack

/**
 * Where the boat was, as the readings say.
 *
 * Fixes tell how far a course may follow them by how well it foretells others. Those whose errors keep to themselves for
 * long foretell each other, and a course that follows such errors has quick changes that the boat did not see: a response
 * that shows less of these then looks likelier than the true one. The readings know: water is alike on all passes only
 * along the course that the boat took.
 */
internal class BlindCourse(private val search: BlindSearch) {
    /** The course of the readings' [series] under which [state] is likeliest, if it is by far; null where that is its own. */
    fun likelier(state: BlindState, series: MeasuredSeries): SmoothTrack? {
        val courses = SmoothTrack.wider(series)
        val scores = search.loops.all(courses) { score(it, state) }
        val best = scores.indices.maxByOrNull { scores[it] } ?: return null
        return courses[best].takeIf { scores[best] > state.score + BlindLag.MUCH }
    }

    private fun score(course: SmoothTrack, state: BlindState): Double {
        val waves = state.modes.at(course, state.variances) ?: return Double.NEGATIVE_INFINITY
        val noise = state.fit.design.noise
        return search.on(course)
            .settled(state.model.terms, state.numbers, noise, waves.first, BlindSearch.FIRST_ROUNDS, waves).score
    }

    companion object {
        /** Twice a log-likelihood by which all is likelier along another course than by chance of the search. */
        const val CLEARLY = 30.0
    }
}
