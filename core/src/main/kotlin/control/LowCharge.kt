package stillwater.control

/**
 * Tells that a battery is low: once it has been below [lowest] for [lowFor] s on end, for a single word of it may be
 * wrong and a load makes a voltage sag. What was low under way stays low: a battery at rest recovers, and is empty all
 * the same. Before, another may have been put in, which is so once it has not been low for as long. Confined to one
 * thread.
 *
 * @param lowest in the unit of what is watched; 0 where nothing is to be.
 * @param lowFor s, at least 0.
 */
internal class LowCharge(private val lowest: Double, private val lowFor: Double) {
    private var since = Double.NaN
    private var goodSince = Double.NaN

    /** Whether it is low, or was low under way. */
    var isLow = false
        private set

    /**
     * At [seconds] the charge is [charge]; NaN where nobody has said, which is not low. [mayCharge] tells that the boat
     * is not under way yet.
     */
    fun watch(charge: Double, seconds: Double, mayCharge: Boolean) {
        since = if (charge < lowest) (if (since.isNaN()) seconds else since) else Double.NaN
        goodSince = if (charge >= lowest) (if (goodSince.isNaN()) seconds else goodSince) else Double.NaN
        if (seconds - since >= lowFor) isLow = true
        if (mayCharge && seconds - goodSince >= lowFor) isLow = false
    }
}
