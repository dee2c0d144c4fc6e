package stillwater.model

/**
 * What else was measured when a reading was taken: speed through the water, temperature, heading and the like.
 *
 * Immutable and shareable. Names are the log's own or the standard ones below; units are SI, except temperatures
 * in degrees Celsius.
 */
public class Conditions(values: Map<String, Double>) {
    private val values: Map<String, Double> = values.toMap()

    /** The value called [name], or NaN where it was not measured. */
    public operator fun get(name: String): Double = values[name] ?: Double.NaN

    /** The names that have a value. */
    public val names: Set<String> get() = values.keys

    override fun equals(other: Any?): Boolean = other is Conditions && other.values == values

    override fun hashCode(): Int = values.hashCode()

    override fun toString(): String = "Conditions($values)"

    public companion object {
        /** Nothing else was measured. */
        public val NONE: Conditions = Conditions(emptyMap())

        /** Speed through the water, m/s. */
        public const val SPEED: String = "speed"

        /** Water temperature, °C. */
        public const val TEMPERATURE: String = "temperature"

        /**
         * Standard deviation of the reading's own place, each axis, m, at least 0: how well it is known where the boat was.
         * Where it is missing nobody said, and the place is taken at its word.
         */
        public const val POSITION_DEVIATION: String = "position_deviation"

        /** Heading, rad, counter-clockwise from east. */
        public const val HEADING: String = "heading"
    }
}
