package stillwater.sensor

import stillwater.model.Conditions

/**
 * Hysteresis that does not depend on rate: a sensor that follows only when the truth has moved by more than a dead band,
 * as a mechanism with backlash does. |s − ψ| ≤ w / 2, and s moves only when it must (the play operator).
 *
 * Source: Visintin 1994, Differential Models of Hysteresis, doi:10.1007/978-3-662-11557-2, chapter III.
 *
 * @property width w, sensor units, at least 0 and finite.
 * @param initial the sensor's state before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class Play(public val width: Double, initial: Double) : SensorModel {
    init {
        require(width >= 0 && width.isFinite()) { "width ($width) must be at least 0 and finite" }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private var state = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return state
        state = state.coerceIn(inRange(input - width / 2), inRange(input + width / 2))
        return state
    }
}
