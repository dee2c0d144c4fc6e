package stillwater.benchmark

import stillwater.run.ExperimentSettings
import stillwater.world.SimulatedConditions

/** What of a sensor has no effect, or not the one meant, in a benchmark's fields. */
internal object SensorCautions {
    /** Of [settings]' sensor, one sentence each. */
    fun of(settings: ExperimentSettings): List<String> = listOfNotNull(SimulatedConditions.missing(settings.sensor))
}
