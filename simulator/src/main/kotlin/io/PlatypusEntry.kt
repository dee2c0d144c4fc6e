package stillwater.io

/** What one line of a Platypus log says. */
internal sealed interface PlatypusEntry {
    /**
     * Where the boat was, as logged: [easting] and [northing] in m, [zone] such as "17North", [heading] in rad,
     * counter-clockwise from east, NaN where it cannot be read.
     */
    data class Pose(val easting: Double, val northing: Double, val zone: String, val heading: Double) : PlatypusEntry

    /** Numbers that the sensor [type] on [channel] (-1 where the line names none) gave; "" type in broken lines. */
    class Sensor(val type: String, val channel: Int, val data: List<Double>) : PlatypusEntry

    /** The start of a log, with the Unix time of its zero, ms. */
    data class Start(val epochMillis: Double) : PlatypusEntry

    /** Commands, gains and whatever else has no part in a map. */
    data object Other : PlatypusEntry

    /** A line that cannot be read, because [expected] was not there. */
    data class Unreadable(val expected: String) : PlatypusEntry
}
