package stillwater.correct

import stillwater.estimate.FailedReference
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings

/**
 * The references of a log, NaN where there is none.
 *
 * @property measured as they were measured, without those that failed and, where they are late, earlier; length n.
 * @property water what they say of the water: [measured], or without their noise; length n. @property isSmoothed whether
 *   [water] is without noise. @property faults what is to be said of them.
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
            val smoothed = if (isLearned) NoisyReference.smoothed(series, found, unusable) else null
            val water = smoothed ?: found
            val late = if (isLearned) LateReference.seconds(series, water, unusable) else 0.0
            val faults = listOfNotNull(
                FailedReference.words(failed.size).takeIf { failed.isNotEmpty() },
                smoothed?.let { NoisyReference.words(found, it) },
                LateReference.words(late).takeIf { late > 0 },
            )
            val measured = LateReference.earlier(series, found, late)
            val told = if (smoothed == null) measured else LateReference.earlier(series, smoothed, late)
            return References(measured, told, smoothed != null, faults)
        }
    }
}
