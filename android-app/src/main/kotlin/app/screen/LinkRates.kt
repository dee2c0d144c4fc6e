package stillwater.app.screen

import stillwater.app.service.BoatSnapshot

/** How fast the counters of a link rise. Confined to the main thread. */
internal class LinkRates {
    /** Bytes received a second over the last seconds; null before two looks. */
    var bytes: Double? = null
        private set

    /** Readings a second, likewise. */
    var readings: Double? = null
        private set

    private val looks = ArrayDeque<LongArray>()
    private var counted: Any? = null

    /** Notes the counters of [snapshot] at [millis] of a clock that never stands still. */
    fun look(millis: Long, snapshot: BoatSnapshot) {
        val now = longArrayOf(millis, snapshot.link.bytesIn, snapshot.mission?.counts?.received ?: 0)
        // Another link or mission counts anew.
        val source = snapshot.linkName to snapshot.mission?.spec
        val isOther = counted != source || (looks.isNotEmpty() && (1..2).any { now[it] < looks.last()[it] })
        if (isOther) looks.clear()
        counted = source
        if (looks.isNotEmpty() && looks.last()[0] == millis) return
        looks.addLast(now)
        while (looks.size > 2 && millis - looks.first()[0] > SPAN_MILLIS) looks.removeFirst()
        bytes = rate(1)
        readings = rate(2)
    }

    private fun rate(counter: Int): Double? {
        if (looks.size < 2) return null
        val (first, last) = looks.first() to looks.last()
        if (last[0] - first[0] < LEAST_MILLIS) return null
        return (last[counter] - first[counter]) * MILLIS_PER_SECOND / (last[0] - first[0])
    }

    private companion object {
        const val SPAN_MILLIS = 10_000L
        const val LEAST_MILLIS = 2_000L
        const val MILLIS_PER_SECOND = 1000.0
    }
}
