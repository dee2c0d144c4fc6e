package stillwater.model

/**
 * A JSON text that is not of the form that was asked for; the message is one line.
 *
 * @param what was asked for, such as `a mission`.
 * @property place `LINE:COLUMN`, both counted from 1.
 * @property words the field, such as `area.shore[2].x_m`, what was expected there and what was found.
 */
public class JsonProblem internal constructor(
    what: String,
    public val place: String,
    public val words: String,
    cause: Throwable? = null,
) : IllegalArgumentException("not $what: $place: $words", cause)
