package stillwater.estimate

/** Goes through readings: a sensor model's filters. */
internal interface ReadingPlayer {
    /** Filters that take a step with a reading: what it costs. */
    val filters: Int

    /**
     * The boat, of which a reading was taken before, came into the cell with [slot] at some time between [from] and
     * [until], s, neither before that reading nor after the next, which is of that cell. Where it is not known to have
     * come there at another time it did so right after the last reading.
     */
    fun enter(slot: Int, from: Double, until: Double)

    /** Takes the scaled reading [value] in the cell with [slot], or under water that is no cell's; see [Crossings]. */
    fun take(slot: Int, seconds: Double, value: Double)

    /** The boat left without a reading of where it went: the next one finds the sensor in an unknown state. */
    fun leave()
}

/**
 * The first readings of a survey, kept to be gone through again.
 *
 * @param capacity readings and interruptions it holds. @param width size of a cell along the grid's first axis, m.
 * @param height along its second one, m.
 */
internal class ReadingTape(capacity: Int, private val width: Double = 1.0, private val height: Double = 1.0) {
    private val slots = IntArray(capacity)
    private val times = DoubleArray(capacity)
    private val values = DoubleArray(capacity)

    /** Where readings were taken, see [Place], from the first on that says how well that is known. */
    private var along = DoubleArray(0)
    private var across = DoubleArray(0)
    private var deviations = DoubleArray(0)
    private var areNearBorder = BooleanArray(0)

    /** Whether a reading on the tape says how well its place is known. */
    var tellsOfPlaces: Boolean = false
        private set

    /** Readings and interruptions on the tape. */
    var size: Int = 0
        private set

    /** Whether all there was is on the tape. */
    var isComplete: Boolean = true
        private set

    /** Slot of the cell in which reading [i] was taken, [LagBank.NONE] for an interruption. */
    fun slot(i: Int): Int = slots[i]

    /** When reading [i] was taken, s. */
    fun time(i: Int): Double = times[i]

    /** What reading [i] said, scaled. */
    fun value(i: Int): Double = values[i]

    /** A place for [bring]. */
    fun newPlace(): Place = Place(width, height)

    /** Sets [place] to where reading [i] was taken. */
    fun bring(i: Int, place: Place) {
        if (tellsOfPlaces) place.set(along[i], across[i], deviations[i], areNearBorder[i]) else place.forget()
    }

    /** Mean time spent in a cell at a stretch among the first [count], s; 0 for none. */
    fun meanStay(count: Int = size): Double {
        var sum = 0.0
        var stays = 0
        for (i in 0 until count) {
            if (slots[i] == LagBank.NONE) continue
            val goesOn = i > 0 && slots[i - 1] != LagBank.NONE
            if (goesOn) sum += times[i] - times[i - 1]
            if (!goesOn || slots[i] != slots[i - 1]) stays++
        }
        return if (stays == 0) 0.0 else sum / stays
    }

    /** Whether there is room for another. */
    val hasRoom: Boolean get() = size < slots.size

    /** Share of the stays among the first [among] that have [count] readings surely of their cell; 0 for none. */
    fun shareOfStays(count: Int, among: Int): Double {
        var sure = 0
        var stays = 0
        var enough = 0
        for (i in 0 until among) {
            if (slots[i] == LagBank.NONE) continue
            if (i == 0 || slots[i] != slots[i - 1]) {
                stays++
                sure = 0
            }
            if (!(tellsOfPlaces && areNearBorder[i]) && ++sure == count) enough++
        }
        return if (stays == 0) 0.0 else enough.toDouble() / stays
    }

    /**
     * Keeps a reading, where there is room; [slot] may be [LagBank.NONE] for an interruption. [place] is where it was taken,
     * null where nothing is to be said of that.
     */
    fun add(slot: Int, seconds: Double, value: Double, place: Place? = null) {
        if (!hasRoom) {
            isComplete = false
            return
        }
        slots[size] = slot
        times[size] = seconds
        if (place?.isKnown == true && !tellsOfPlaces) beginPlaces()
        if (tellsOfPlaces) {
            along[size] = place?.along ?: Double.NaN
            across[size] = place?.across ?: Double.NaN
            deviations[size] = place?.deviation ?: Double.NaN
            areNearBorder[size] = place?.isNearBorder == true
        }
        values[size++] = value
    }

    private fun beginPlaces() {
        tellsOfPlaces = true
        along = DoubleArray(slots.size)
        across = DoubleArray(slots.size)
        deviations = DoubleArray(slots.size)
        areNearBorder = BooleanArray(slots.size)
        deviations.fill(Double.NaN, 0, size)
    }
}
