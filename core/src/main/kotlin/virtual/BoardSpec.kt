package stillwater.virtual

/**
 * Generations of the boards' firmware, which differ in when they speak and in what wakes their motors.
 *
 * @property watchdog without a byte for so long the motors go to zero, s.
 */
public enum class Firmware(public val watchdog: Double) {
    /**
     * Platypus v4.2.0 on its serial line, firmware.ino and Components.cpp of branch feature/v4_2_0.
     *
     * Speaks of motors only while it is active and has armed them. Says active from the moment it is told to arm, not when
     * it has. Disarming makes it connected: motors at zero, but powered. So does its watchdog, and then only the word to
     * arm makes it active. After 5 s without a byte it is in standby, and the next byte makes it connected. Reads a port's
     * probe only once it was told what is there, and forgets it at each reset.
     */
    V4_2(watchdog = 3.0),

    /**
     * The branch master before it, on its accessory line.
     *
     * Knows nothing of states and refuses each word of them. Arms its motors by itself after a reset. Runs while it is told
     * anything, and speaks of motors only then; motors go to zero without, and the next line makes it run again. Its
     * probes are built in.
     */
    MASTER(watchdog = 0.5),
}

/**
 * The electronics of a virtual boat.
 *
 * @property firmware what is on it.
 * @property watchdog without a byte for so long the motors go to zero, s.
 * @property standby firmware v4.2.0 takes the power from its motors after so long without a byte, s.
 * @property arming time that arming both motors takes, s: two of the firmware's default controllers 4.2 s, others up to 36.
 * @property booting time after a reset in which nothing is heard or said, s.
 * @property oxygenPeriod time between readings of the probe on port 1, s: about 3, on older boards 0.5.
 * @property batteryPeriod time between lines of the battery, s: 1 to 5.
 * @property volts of the battery, V.
 * @property knowsProbe whether port 1 has its probe built in; else it is silent until it was told, and after each reset.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoardSpec(
    val firmware: Firmware = Firmware.V4_2,
    val watchdog: Double = firmware.watchdog,
    val standby: Double = 5.0,
    val arming: Double = 4.2,
    val booting: Double = 2.0,
    val oxygenPeriod: Double = 3.0,
    val batteryPeriod: Double = 5.0,
    val volts: Double = 15.3,
    val knowsProbe: Boolean = firmware == Firmware.MASTER,
) {
    init {
        for ((name, value) in listOf(
            "watchdog (s)" to watchdog,
            "standby (s)" to standby,
            "arming (s)" to arming,
            "booting (s)" to booting,
            "oxygenPeriod (s)" to oxygenPeriod,
            "batteryPeriod (s)" to batteryPeriod,
            "volts (V)" to volts,
        )) {
            require(value > 0 && value.isFinite()) { "$name ($value) must be above 0 and finite" }
        }
    }
}
