package stillwater.diagnose.blind

import stillwater.diagnose.all
import stillwater.diagnose.track.SmoothTrack

/**
 * That of [courses] along which [state] is likeliest, if it is by far; null for none.
 *
 * Fixes tell how far a course may follow them by how well it foretells others. Those whose errors keep to themselves for
 * long foretell each other, and a course that follows such errors has quick changes that the boat did not see: a response
 * that shows less of these then looks likelier than the true one. The readings know: water is alike on all passes only
 * along the course that the boat took.
 */
internal fun BlindSearch.likelierCourse(courses: List<SmoothTrack>, state: BlindState): SmoothTrack? {
    val scores = loops.all(courses) { course ->
        state.modes.at(course, state.variances)?.let { begunIn(it, state).score } ?: Double.NEGATIVE_INFINITY
    }
    val best = scores.indices.maxByOrNull { scores[it] } ?: return null
    return courses[best].takeIf { scores[best] > state.score + BlindLag.MUCH }
}
