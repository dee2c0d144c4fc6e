package stillwater.run

import stillwater.estimate.IntervalFilterSettings
import stillwater.estimate.SelfCalibratingSettings

/**
 * What the filters that reckon with a lag may assume of the sensor.
 *
 * @property interval limit of the response and of a reading's error, for the interval filter.
 * @property selfCalibrating what is believed of the time constant beforehand, for the self-calibrating estimator.
 * @property learnsResponse whether the extended bounded filter learns distances per slope; if not, its bounds come from
 *   the direction of the readings alone.
 */
data class LagFilterSettings(
    val interval: IntervalFilterSettings = IntervalFilterSettings(longestTimeConstant = 60.0),
    val selfCalibrating: SelfCalibratingSettings = SelfCalibratingSettings(),
    val learnsResponse: Boolean = true,
)
