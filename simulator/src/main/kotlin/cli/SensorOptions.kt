package stillwater.cli

import com.github.ajalt.clikt.parameters.groups.OptionGroup
import com.github.ajalt.clikt.parameters.options.option
import stillwater.sensor.FirstOrderLag
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage

/** The options that change the simulated sensor. */
class SensorOptions : OptionGroup(name = "Sensor") {
    private val sensor by option(
        "--sensor",
        metavar = "FILE",
        help = "sensor spec (JSON) instead of the preset's; sensor.json of an earlier run is an example",
    )
    private val alpha by option(
        "--alpha",
        metavar = "A",
        help = "first-order lag that closes the share A of its distance with each reading, instead of the preset's " +
            "response",
    ).number("a number above 1e-300 and below 1") { it > SMALLEST_ALPHA && it < 1 }
    private val noise by option("--noise", metavar = "SD", help = "standard deviation of the sensor's noise")
        .number("a number within 0..1000000") { it in 0.0..MOST_NOISE }
    private val quantum by option("--quantum", metavar = "STEP", help = "resolution of the sensor, 0 for none")
        .number("a number of at least 0") { it >= 0 }

    /**
     * [preset] with what was given on the command line in its place.
     *
     * @param period time between readings, s.
     */
    fun applied(preset: SensorSpec, period: Double): SensorSpec {
        val file = sensor
        if (file != null) {
            if (listOf(alpha, noise, quantum).any { it != null }) {
                throw BadFlag("--sensor", "either --sensor or --alpha, --noise and --quantum", "both")
            }
            return SensorFile.read("--sensor", file)
        }
        if (listOf(alpha, noise, quantum).all { it == null }) return preset
        val response = alpha?.let { listOf(SensorStage.Lag(FirstOrderLag.timeConstant(it, period))) }
            ?: preset.stages.filter { it !is SensorStage.Noise && it !is SensorStage.Quantum }
        val noises = noise?.let { sd -> listOf(SensorStage.Noise(sd)).filter { sd > 0 } }
            ?: preset.stages.filterIsInstance<SensorStage.Noise>()
        val quanta = quantum?.let { step -> if (step > 0) listOf(SensorStage.Quantum(step)) else emptyList() }
            ?: preset.stages.filterIsInstance<SensorStage.Quantum>()
        val changes = listOfNotNull(
            alpha?.let { "alpha $it" },
            noise?.let { "noise $it" },
            quantum?.let { "quantum $it" },
        )
        val base = if (alpha == null) preset.name else "first-order-lag"
        return SensorSpec("$base ${changes.joinToString(" ")}", response + noises + quanta)
    }

    /** The flags given, with their values, for writing the command down. */
    fun flags(): List<Pair<String, Any?>> =
        listOf("--sensor" to sensor, "--alpha" to alpha, "--noise" to noise, "--quantum" to quantum)

    private companion object {
        /** Smaller ones have no finite time constant. */
        const val SMALLEST_ALPHA = 1e-300

        /** A million times the range of the fields; squares of errors stay numbers. */
        const val MOST_NOISE = 1e6
    }
}
