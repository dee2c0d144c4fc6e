package stillwater.diagnose.evidence

import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.Term

/**
 * A cause tried on top of a model.
 *
 * @property term what was tried. @property fit the model with it. @property ratio twice the gain in log-likelihood,
 * divided by [inflation], which the scores' correlation inflates it by. @property degrees numbers more than without it.
 * @property cost what as many meaningless numbers and places would gain, as twice a log-likelihood.
 * @property worth what it gains beyond [cost]; nothing, -∞, where held-out blocks are left worse than without it.
 * @property pValue of [ratio], with the search for places of jumps allowed for. @property heldOut score on held-out
 * blocks. @property foretells whether it foretells rows it was not fitted to better than the model without it.
 */
internal class Trial(
    val term: Term,
    val fit: ModelFit,
    val ratio: Double,
    val inflation: Double,
    val degrees: Int,
    val cost: Double,
    val worth: Double,
    val pValue: Double,
    val heldOut: HeldOutScore,
    val foretells: Boolean,
)
