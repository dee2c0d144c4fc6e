package stillwater.sensor

import stillwater.model.Conditions

/**
 * How a sensor, or one part of it, turns what it is given into what it says.
 *
 * Stateful: a model is one sensor in one stretch of time. Models compose by feeding the output of one into the next
 * ([SensorChain]). No step throws on data; a model given a value that is not finite keeps its state and repeats its
 * last output unless it says otherwise.
 */
public fun interface SensorModel {
    /**
     * The output after the input was [input] for [dt] seconds.
     *
     * @param input the truth, or the output of the model before, sensor units.
     * @param dt time since the last step, s. Not above 0 or not finite counts as 0.
     * @param conditions what else holds at this moment.
     * @return the output, sensor units.
     */
    public fun step(input: Double, dt: Double, conditions: Conditions): Double
}

/** Models in a row, each fed by the one before. [models] is not copied and must not be changed; empty passes all. */
internal class SensorChain(private val models: Array<SensorModel>) : SensorModel {
    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        var value = input
        for (model in models) value = model.step(value, dt, conditions)
        return value
    }
}
