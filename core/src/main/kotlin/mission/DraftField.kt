package stillwater.mission

/**
 * What a person fills in of a mission; a problem is shown where it is.
 *
 * @property start the text of a number before anyone has typed; null for what is not a number in a text.
 * @property unit of the number, as it is written behind it; empty for shares, the probe's own unit and what is no
 *   number.
 * @property optional whether the text may be empty.
 */
public enum class DraftField(
    public val start: String? = null,
    public val unit: String = "",
    public val optional: Boolean = false,
) {
    /** What lists call the mission. */
    NAME,

    /** Shore and keep-outs. */
    AREA,

    /** Where it ends. */
    HOME,

    /** Side of a cell of the map. */
    CELL("5", "m"),

    /** Port of the board that the probe is on. */
    PORT("", optional = true),

    /** Least value the water can have. */
    LOWEST("0"),

    /** Greatest value the water can have. */
    HIGHEST("20"),

    /** Largest step between readings that needs no confirmation. */
    LARGEST_JUMP("", optional = true),

    /** Equal readings in a row that a sound probe does not give. */
    STUCK_AFTER("", optional = true),

    /** Least change of the readings that counts as one. */
    SMALLEST_SLOPE("", optional = true),

    /** Most that a reading may be off. */
    READING_ERROR("", optional = true),

    /** From sample to arrival. */
    LATENCY("0", "s"),

    /** Slowest response that is possible. */
    SLOWEST("20", "s"),

    /** Who plans the way. */
    PLANNER,

    /** What may be used, in the budget's unit. */
    BUDGET("1000"),

    /** Share of the way home that is kept. */
    RESERVE("0.2"),

    /** At full thrust. */
    TOP_SPEED("1.6", "m/s"),

    /** On the way. */
    CRUISE("1", "m/s"),

    /** How near is there. */
    ARRIVAL("1.5", "m"),

    /** Below which the boat's battery is low; nobody but a person knows which battery it is, so it begins empty. */
    LOWEST_VOLTS("", "V"),

    /** Below which the phone's battery is low. */
    LOWEST_PHONE("15", "%"),
    ;

    public companion object {
        /** Those that are numbers, in the order in which they are asked for. */
        public val NUMBERS: List<DraftField> = entries.filter { it.start != null }
    }
}
