package stillwater.estimate

/**
 * Where a boat crossed from cell to cell, for readings whose places are known to some error only.
 *
 * A reading so near to a border that it may be of the next cell tells of neither: it is passed over. The time from the last
 * reading that is surely of one cell to the first that is surely of another was spent in both, nobody knows how long in
 * each: it counts as spent in water of its own that is not mapped ([water]), so that the sensor's state goes on from there
 * and no cell's value suffers. What it costs is that reading. Where stays are so short that little is left of them,
 * readings are taken at their word. Readings that say nothing of their place's error are, too.
 *
 * Source: core/docs/SelfCalibratingEstimator.md, section "Where the boat was". Confined to one thread.
 */
internal class Crossings {
    private var last = LagBank.NONE
    private var isBetween = false

    /** Whether borders are treated so; where not, every reading is of the cell it is believed to be in. */
    var areHeeded: Boolean = false

    /** The boat left without a reading of where it went. */
    fun leave() {
        last = LagBank.NONE
        isBetween = false
    }

    /** What the reading in the cell with [slot] counts for, its place known as [place] says: below 0 for no cell. */
    fun slot(slot: Int, place: Byte): Int {
        if (!areHeeded || place == EXACT) {
            last = slot
            isBetween = false
            return slot
        }
        if (place == NEAR) {
            isBetween = last != LagBank.NONE
            return PASSED_OVER
        }
        val crosses = isBetween || (last != LagBank.NONE && last != slot)
        last = slot
        isBetween = false
        return if (crosses) water(slot) else slot
    }

    companion object {
        /** Nothing was said of the place's error. */
        const val EXACT: Byte = 0

        /** Surely of its cell. */
        const val SURE: Byte = 1

        /** So near to a border that it may be of another cell. */
        const val NEAR: Byte = 2

        /** Stands for a cell where a reading is not to be taken. */
        const val PASSED_OVER = Int.MIN_VALUE

        /** Stands for the cell with the water on the way into the cell with [slot]; never the same twice in a row. */
        private fun water(slot: Int) = LagBank.NONE - 1 - slot
    }
}
