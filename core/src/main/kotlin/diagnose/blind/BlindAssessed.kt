package stillwater.diagnose.blind

import stillwater.diagnose.evidence.HeldOutScore

/** What is asked of [state] more than once, each time by its stretches. */
internal class BlindAssessed(search: BlindSearch, state: BlindState) {
    private val stretches = Stretches(state.fit)

    /** How well stretches are foretold by all others. */
    val heldOut: HeldOutScore by lazy { BlindHeldOut.score(state, stretches) }

    /** How far the numbers may be off, on their fitted scales. */
    val errors: DoubleArray by lazy { BlindErrors.of(search, state, stretches) }
}
