package stillwater.diagnose

/** A cause that was added: [trial], among what it was chosen from, and the model with it. */
internal class BlindStep(val trial: BlindTrial, val round: BlindRound, val state: BlindState)
