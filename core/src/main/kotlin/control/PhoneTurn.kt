package stillwater.control

/**
 * What a phone's rotation sensor and gyroscope say of the boat it is strapped to, however it lies.
 *
 * A compass counts degrees clockwise from north, a boat here radians counter-clockwise from east: h = π/2 − c π/180.
 */
public object PhoneTurn {
    private const val SPACE = 3
    private const val UP = 6
    private const val QUARTER = 90.0
    private const val FULL = 360.0

    /** Heading, rad, counter-clockwise from east, of what points to [compassDeg], degrees clockwise from true north. */
    public fun heading(compassDeg: Double): Double = Math.toRadians(QUARTER - compassDeg)

    /** The inverse of [heading]: degrees clockwise from north, in 0 until 360. */
    public fun compassDeg(heading: Double): Double = (QUARTER - Math.toDegrees(heading)).mod(FULL)

    /**
     * Rate of turn about the upright axis, rad/s, counter-clockwise seen from above: the rotation's last row points up
     * in the phone's axes, and ψ' = u · ω.
     *
     * @param rotation from the phone's axes to east, north and up, row-major 3 × 3, as Android has it. Not modified.
     * @param rates about the phone's own axes, rad/s, length 3 at least. Not modified.
     */
    public fun yawRate(rotation: FloatArray, rates: FloatArray): Double =
        (0 until SPACE).sumOf { (rotation[UP + it] * rates[it]).toDouble() }
}
