package stillwater.hidden

/** What logs of the sealed generator have. */
internal enum class Regime(private val label: String, val withReference: Boolean, private val inField: Boolean) {
    REFERENCE("reference", true, false),
    BLIND("blind", false, false),
    REFERENCE_FIELD("reference-field", true, true),
    BLIND_FIELD("blind-field", false, true),
    ;

    /** The case of [seed]; of a twin see [HiddenCase]. */
    fun case(seed: Long, isTwin: Boolean = false) =
        HiddenCase(seed, withReference, isTwin = isTwin, inField = inField)

    companion object {
        /** The regime that [label] names. */
        fun of(label: String): Regime = requireNotNull(entries.find { it.label == label }) {
            "expected one of ${entries.joinToString { it.label }}, found $label"
        }
    }
}
