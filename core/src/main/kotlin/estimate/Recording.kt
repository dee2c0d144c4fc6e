package stillwater.estimate

/**
 * The first readings of a [ReadingTape] as a sensor model is fitted to them: so many of them, with borders heeded or
 * not, gone through a part at a time.
 *
 * @param tape where they are kept; it may grow meanwhile.
 * @param parts is told what is done, in steps of a filter.
 */
internal class Recording(private val tape: ReadingTape, private val parts: Parts, heedsBorders: Boolean) {
    /** What readings near borders count for, as after the last reading that was gone through. */
    val crossings = Crossings().also { it.areHeeded = heedsBorders }
    private val place = tape.newPlace()

    /** Readings and interruptions to be fitted to. */
    var size: Int = 0
        private set

    /** From now on the first [size] on the tape count, and nothing that comes. */
    fun begin(size: Int) {
        this.size = size
    }

    /** See [ReadingTape]; of the first [size]. */
    fun slot(i: Int): Int = tape.slot(i)

    /** See [ReadingTape]. */
    fun time(i: Int): Double = tape.time(i)

    /** See [ReadingTape]. */
    fun value(i: Int): Double = tape.value(i)

    /** Mean time spent in a cell at a stretch, s. */
    fun meanStay(): Double = tape.meanStay(size)

    /**
     * Goes through all with [player], or as far as what it found may still count: once [isBeaten] says that it
     * cannot, the rest is not gone through. It is told as done all the same, so that a fit is complete at the same
     * reading.
     */
    suspend fun play(player: ReadingPlayer, isBeaten: () -> Boolean = NEVER) {
        crossings.leave()
        play(player, 0, size, isBeaten)
    }

    /** Goes with [player], which has gone through the first [size], through all that came since. */
    suspend fun playOn(player: ReadingPlayer) {
        while (size < tape.size) {
            val from = size
            size = tape.size
            play(player, from, size, NEVER)
        }
    }

    /** For work other than going through readings, worth so many steps of a filter. */
    suspend fun spend(steps: Int) = parts.spend(steps.toDouble())

    private suspend fun play(player: ReadingPlayer, start: Int, end: Int, isBeaten: () -> Boolean) {
        var from = start
        var counts = true
        while (from < end) {
            val to = minOf(from + AT_ONCE, end)
            if (counts) {
                playAtOnce(player, from, to)
                counts = !isBeaten()
            }
            parts.spend((to - from) * player.filters.toDouble())
            from = to
        }
    }

    private fun playAtOnce(player: ReadingPlayer, from: Int, to: Int) {
        for (i in from until to) {
            if (tape.slot(i) == LagBank.NONE) {
                crossings.leave()
                player.leave()
                continue
            }
            tape.bring(i, place)
            val slot = crossings.slot(tape.slot(i), tape.time(i), place)
            if (slot == Crossings.PASSED_OVER) continue
            if (crossings.isTimed) player.enter(slot, crossings.from, crossings.until)
            player.take(slot, tape.time(i), tape.value(i))
        }
    }

    companion object {
        /** For a player that counts to the end, whatever it finds. */
        val NEVER: () -> Boolean = { false }

        /** Readings gone through without looking whether there is time. */
        private const val AT_ONCE = 64
    }
}
