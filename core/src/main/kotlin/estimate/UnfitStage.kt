package stillwater.estimate

/**
 * A stage of a sensor that cannot be undone; the message says why.
 *
 * @property index of the first such stage among the sensor's, from 0.
 */
public class UnfitStage internal constructor(public val index: Int, why: IllegalArgumentException) :
    IllegalArgumentException(why.message, why)
