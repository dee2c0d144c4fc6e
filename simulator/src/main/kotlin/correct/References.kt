package stillwater.correct

import stillwater.estimate.FailedReference
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings

/**
 * The references of a log, NaN where there is none.
 *
 * @property measured as they were measured, without those that failed and, where they are late, earlier; length n.
 * @property water what they say of the water: [measured], or without their noise, or with the rows between them filled in;
 *   length n. @property isSmoothed whether [water] is not [measured]. @property faults what is to be said of them.
 */
internal class References private constructor(
    val measured: DoubleArray,
    val water: DoubleArray,
    val isSmoothed: Boolean,
    val faults: List<String>,
) {
    companion object {
        /** Those [shown] beside the readings of [series]; noise and delay only where a sensor [isLearned] from them. */
        fun of(
            series: TrackSeries,
            shown: DoubleArray,
            unusable: UnusableReadings,
            isLearned: Boolean,
        ): References {
            val found = shown.copyOf()
            val failed = FailedReference.rows(series.values, found).onEach { found[it] = Double.NaN }
            val filled = if (isLearned) ReferenceWater.filled(series, found) else null
            val smoothed = if (isLearned && filled == null) ReferenceWater.smoothed(series, found, unusable) else null
            val water = filled ?: smoothed ?: found
            val late = if (isLearned) LateReference.seconds(series, water, unusable) else 0.0
            val faults = listOfNotNull(
                FailedReference.words(failed.size).takeIf { failed.isNotEmpty() },
                filled?.let { ReferenceWater.filledWords(series, found) },
                smoothed?.let { ReferenceWater.words(found, it) },
                LateReference.words(late).takeIf { late > 0 },
            )
            val measured = LateReference.earlier(series, found, late)
            val told = if (water === found) measured else LateReference.earlier(series, water, late)
            return References(measured, told, water !== found, faults)
        }
    }
}
