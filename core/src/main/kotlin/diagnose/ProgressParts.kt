package stillwater.diagnose

/** Progress of what is done in parts, of which it is not known how many there will be. */
internal class ProgressParts(private val progress: (Double) -> Unit) {
    private var done = 0.0

    /** What the next part, a [share] of what is left, is to tell of itself: a share within 0..1 that grows. */
    fun next(share: Double): (Double) -> Unit {
        val from = done
        val width = share * (1 - from)
        done = from + width
        return { progress(from + width * it) }
    }
}
