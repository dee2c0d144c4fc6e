package stillwater.diagnose.noise

/**
 * Errors of fixes: the boat was not where the log says, and the sensor saw other water. The error on either axis is an
 * Ornstein-Uhlenbeck process; what it shifts readings by is the water's gradient times it, as the lag shows that.
 *
 * @property east how the water rises to the east at each row, sensor units/m. @property north the same to the north.
 * @property variance of the error on either axis, m², over the noise's variance, sensor units². @property time its
 *   correlation time, s. @property timeConstant the lag's, s.
 */
internal class PlaceErrors(
    val east: DoubleArray,
    val north: DoubleArray,
    val variance: Double,
    val time: Double,
    val timeConstant: Double,
)
