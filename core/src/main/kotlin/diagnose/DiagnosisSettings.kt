package stillwater.diagnose

import stillwater.sensor.SensorSpec

/**
 * How strict a diagnosis is. The defaults were set on logs of a simulated campaign and judged on others; see
 * docs/diagnosis.md.
 *
 * @property base the sensor as it is believed to be, taken as given; null fits a first-order lag, and where there is a
 *   reference a gain and an offset.
 * @property level probability, per log, of naming a cause where there is none, dimensionless, within 0..1.
 * @property structureLevel the same of calling structure unexplained.
 * @property separation causes whose likelihood ratios differ by less than this cannot be told apart, dimensionless.
 *   Without a reference.
 * @property setProbability with which an ambiguous set holds the cause, each as likely before.
 * @property mostCauses causes in a combination, at least 1.
 * @property noiseShare wandering slower than this part of the log is structure, not noise: 1 / part, above 1.
 * @property heldOutBelow p-value above which held-out blocks are not looked at.
 */
public data class DiagnosisSettings(
    val base: SensorSpec? = null,
    val level: Double = 0.01,
    val structureLevel: Double = 0.01,
    val separation: Double = 6.5,
    val setProbability: Double = 0.9,
    val mostCauses: Int = 3,
    val noiseShare: Double = 20.0,
    val heldOutBelow: Double = 0.05,
) {
    init {
        require(level > 0 && level < 1) { "level ($level) must be within 0..1" }
        require(structureLevel > 0 && structureLevel < 1) { "structureLevel ($structureLevel) must be within 0..1" }
        require(separation >= 0) { "separation ($separation) must be at least 0" }
        require(setProbability > 0 && setProbability < 1) { "setProbability ($setProbability) must be within 0..1" }
        require(mostCauses >= 1) { "mostCauses ($mostCauses) must be at least 1" }
        require(noiseShare > 1) { "noiseShare ($noiseShare) must be above 1" }
    }
}
