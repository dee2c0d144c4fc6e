package stillwater.estimate

import stillwater.model.Interval

/**
 * The sensors among which a [SelfCalibratingEstimator] chooses.
 *
 * @property label the cause's name as in a sensor spec.
 */
public enum class SensorKind(public val label: String) {
    /** τ ṡ = ψ − s. */
    FIRST_ORDER("first-order-lag"),

    /** The same with one τ for rising and one for falling. */
    ASYMMETRIC("asymmetric-lag"),

    /** A first-order lag that sees the water of a fixed time ago. */
    DEAD_TIME("dead-time"),

    /** Two first-order lags in a row. */
    SECOND_ORDER("second-order"),

    /** |ṡ| ≤ r, no lag otherwise. */
    SLEW_LIMIT("slew-limit"),
}

/** What the readings say of a sensor model. */
public enum class SensorStanding {
    /** Values and bounds of the map are those of this model. */
    CHOSEN,

    /** It explains the readings not clearly worse than the chosen one; or none does, which excludes none. */
    POSSIBLE,

    /** It needs a parameter more than the chosen one, and what that gains is not worth it. */
    NOT_NEEDED,

    /** Another explains the readings clearly better. */
    EXCLUDED,

    /** It has not been tried: there are too few readings yet, or the first-order lag leaves nothing to explain. */
    NOT_TRIED,
}

/**
 * A number of a sensor model.
 *
 * @property name what it is, as in a sensor spec.
 * @property value the most likely value, in [unit].
 * @property interval where it lies with a probability of 95 % if the model is right, in [unit].
 * @property unit s, or sensor units/s.
 */
public data class SensorParameter(
    val name: String,
    val value: Double,
    val interval: Interval,
    val unit: String,
)

/**
 * A sensor model and what the readings say of it.
 *
 * @property kind which one.
 * @property standing whether it is still possible.
 * @property evidence half the difference of the Bayesian information criterion from the best model's: the logarithm of
 *   the odds against it, about; 0 for the best, NaN if not tried; dimensionless.
 * @property parameters its numbers; empty if not tried.
 */
public data class SensorCandidate(
    val kind: SensorKind,
    val standing: SensorStanding,
    val evidence: Double,
    val parameters: List<SensorParameter>,
)

/**
 * What a [SelfCalibratingEstimator] believes of its sensor.
 *
 * @property isExplained whether the chosen model explains the readings. If not, no model does and the map's bounds are
 *   those of the extended bounded filter.
 * @property areCellsEven whether the readings bear out that the water changes at the cells' borders only, or are too
 *   few to say; if not, nothing of the sensor can be learned from them in these cells and [isExplained] is false.
 * @property isWaterSteady false if the readings bear that out in each visit by itself only: the water of cells changed
 *   between visits, and then [isExplained] is false, too. Where [areCellsEven] is false nobody can say, and it is true.
 * @property candidates all models, the chosen one first.
 */
public data class SensorBelief(
    val isExplained: Boolean,
    val areCellsEven: Boolean,
    val isWaterSteady: Boolean,
    val candidates: List<SensorCandidate>,
) {
    /** The model that the map's values rest on. */
    public val chosen: SensorCandidate get() = candidates.first()

    /** The models other than the chosen one that the readings leave possible. */
    public val undecided: List<SensorCandidate>
        get() = candidates.filter { it.standing == SensorStanding.POSSIBLE }
}
