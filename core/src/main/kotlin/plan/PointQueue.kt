package stillwater.plan

/** The points that wait in Dijkstra's algorithm, the nearest first; [distances] is shared with it. */
internal class PointQueue(private val distances: DoubleArray) {
    private val heap = IntArray(distances.size)
    private val places = IntArray(distances.size) { NOT_IN }
    private var size = 0

    val isEmpty: Boolean get() = size == 0

    fun clear() {
        for (i in 0 until size) places[heap[i]] = NOT_IN
        size = 0
    }

    /** Adds [point], or moves it forward where its distance has become less. */
    fun push(point: Int) {
        var place = places[point]
        if (place == NOT_IN) place = size++
        while (place > 0) {
            val above = (place - 1) / 2
            if (distances[heap[above]] <= distances[point]) break
            put(place, heap[above])
            place = above
        }
        put(place, point)
    }

    fun poll(): Int {
        val first = heap[0]
        places[first] = NOT_IN
        val moved = heap[--size]
        if (size == 0) return first
        var place = 0
        while (true) {
            var child = 2 * place + 1
            if (child >= size) break
            if (child + 1 < size && distances[heap[child + 1]] < distances[heap[child]]) child++
            if (distances[heap[child]] >= distances[moved]) break
            put(place, heap[child])
            place = child
        }
        put(place, moved)
        return first
    }

    private fun put(place: Int, point: Int) {
        heap[place] = point
        places[point] = place
    }

    private companion object {
        const val NOT_IN = -1
    }
}
