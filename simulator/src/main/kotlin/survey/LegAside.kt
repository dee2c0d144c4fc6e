package stillwater.survey

import kotlin.math.abs

/**
 * Legs one way that lie to one side of those the other way, as on a circle or where a boat comes back beside its way out:
 * they are of other water, whatever the sensor does.
 *
 * @property distance from the one to the other across the legs, m, above 0.
 * @property difference by how much the water differs along the legs over that distance, or over half a leg where it is
 *   more: what legs so far apart differ by, if the water is as rough across as along; sensor units.
 * @property isFar whether it is more than half a leg, so that nothing along the legs says what the water does over it.
 */
data class LegAside(val distance: Double, val difference: Double, val isFar: Boolean) {
    /** What two lines so far apart may differ by, sensor units: what is usual along the legs says it of one pair to so much. */
    val most: Double get() = if (isFar) Double.POSITIVE_INFINITY else MOST * difference

    internal companion object {
        private const val MOST = 2.0

        /** Of legs with [profiles] in bins of [binWidth] m that lie [distance] m aside. */
        fun of(distance: Double, profiles: List<DoubleArray>, binWidth: Double): LegAside {
            val half = profiles.maxOf { profile -> profile.count { !it.isNaN() } } / 2.0
            val bins = minOf(distance / binWidth, half)
            val whole = bins.toInt()
            val share = bins - whole
            var sum = 0.0
            var count = 0
            for (profile in profiles) {
                for (i in 0 until profile.size - whole - 1) {
                    val there = profile[i + whole] + share * (profile[i + whole + 1] - profile[i + whole])
                    val difference = abs(there - profile[i])
                    if (difference.isNaN()) continue
                    sum += difference
                    count++
                }
            }
            return LegAside(distance, if (count > 0) sum / count else 0.0, isFar = distance / binWidth > half)
        }
    }
}
