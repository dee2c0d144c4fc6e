package stillwater.closedloop

/** What goes wrong in a run of the campaign; [label] is its name in the table. */
internal enum class FaultKind(val label: String) {
    /** Nothing passes, or nothing one way, for 0.1 to 60 s; where nothing passes one way may heal before the other. */
    LINK_CUT("link cuts of 0.1 to 60 s"),

    /** Each byte is another with a probability of 1e-4 to 1e-2, both ways. */
    CORRUPTION("corrupt bytes, 1e-4 to 1e-2"),

    /** The probe says the same for 10 to 60 s. */
    STUCK_READING("stuck readings"),

    /** Readings, headings, yaw rates and the times of fixes that are no numbers; fixes of a time to come. */
    NOT_A_NUMBER("NaN, times to come"),

    /** One to ten fixes 5 to 2000 m off. */
    FIX_JUMP("fix jumps"),

    /** No fix for 3 to 90 s, and every other time the first one to three after it are 5 to 60 m off. */
    FIX_OUTAGE("fix outages of 3 to 90 s"),

    /** The boat's clock passes 2^32 ms, and a board's counter wraps. */
    CLOCK_WRAP("clock wrap at 2^32 ms"),

    /** The board starts anew: disarmed, silent while it boots. */
    BOARD_RESET("board resets"),

    /** The voltage falls, for a moment or for good. */
    BATTERY_SAG("battery sag"),

    /** The process dies at any moment and is started again from a log cut at any byte of its last second. */
    PROCESS_KILL("process killed"),
}
