package stillwater.mission

import stillwater.control.Danger

/** What a person wants of a mission that was started; dangers are graver than any of it. */
public enum class Wish(
    internal val danger: Danger?,
    /** As a log's orders have it. */
    public val word: String,
) {
    /** Survey. */
    GO_ON(null, "go-on"),

    /** Wait with the motors at rest, armed. */
    WAIT(Danger.OPERATOR_WAIT, "wait"),

    /** Stay on the spot, under power. */
    HOLD(Danger.OPERATOR_HOLD, "hold"),

    /** Go home and end the mission there. */
    RETURN(Danger.OPERATOR_RETURN, "return"),
}
