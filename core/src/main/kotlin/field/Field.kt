package stillwater.field

import stillwater.model.BoatTime

/** The true value of the water at a place and time. */
public fun interface Field {
    /**
     * The truth at the point ([x], [y]) at [time], sensor units.
     *
     * @param x metres east in the local frame.
     * @param y metres north in the local frame.
     * @return the truth; NaN where the field is not defined.
     */
    public fun truth(x: Double, y: Double, time: BoatTime): Double
}
