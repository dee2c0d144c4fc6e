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

    /**
     * Steps while the input stays as it is, one after the other: as that many calls of [step], bit for bit.
     *
     * @param input as of [step], the same in all steps.
     * @param dt time from each step to the next, s, as of [step].
     * @param conditions what else holds meanwhile.
     * @param outputs where the output of each step is written to, sensor units, length [count] at least. Modified.
     * @param count how many steps there are.
     */
    public fun stepAll(input: Double, dt: Double, conditions: Conditions, outputs: DoubleArray, count: Int) {
        for (i in 0 until count) outputs[i] = step(input, dt, conditions)
    }
}

/** Models in a row, each fed by the one before. [models] is not copied and must not be changed; empty passes all. */
internal class SensorChain(private val models: Array<SensorModel>) : SensorModel {
    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        var value = input
        for (model in models) value = model.step(value, dt, conditions)
        return value
    }

    /** Several models may draw from one source of chance, in the order of the steps. */
    override fun stepAll(input: Double, dt: Double, conditions: Conditions, outputs: DoubleArray, count: Int) {
        if (models.size == 1) {
            models[0].stepAll(input, dt, conditions, outputs, count)
        } else {
            super.stepAll(input, dt, conditions, outputs, count)
        }
    }
}
