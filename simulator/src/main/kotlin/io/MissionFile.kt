package stillwater.io

import stillwater.mission.MissionSpec
import stillwater.model.JsonForm
import stillwater.sensor.SensorSpec
import java.nio.file.Path
import kotlin.math.abs

/** Reads the file of a mission; numbers that cannot be reckoned with are refused before a boat sets out with them. */
object MissionFile {
    private val FILE = JsonFile("a mission (JSON)")
    private val FORM = JsonForm(MissionSpec.serializer(), "a mission")

    /**
     * The mission in [file].
     *
     * @throws JsonFileProblem if there is none.
     */
    fun read(file: Path): MissionSpec = FILE.read(file, ::mission)

    /** The mission in [text], which messages call [name]; throws as [read] does. */
    fun parse(text: String, name: String): MissionSpec = FILE.parse(text, name, ::mission)

    private fun mission(text: String): MissionSpec {
        val mission = MissionSpec.fromJson(text)
        val probe = mission.probe
        fun refuse(key: String, expected: String, found: Any): Nothing =
            throw FORM.problem(text, "$.probe.$key", "expected $expected, found $found")
        SquareReach.rangeProblem(probe.lowest, probe.highest)?.let { expected ->
            val key = if (abs(probe.lowest) > abs(probe.highest)) "lowest" else "highest"
            refuse(key, expected, "${probe.lowest} to ${probe.highest}")
        }
        val slowest = probe.longestTimeConstant
        if (slowest > SensorSpec.LONGEST_TIME) {
            refuse("longest_time_constant_s", "at most ${SensorSpec.LONGEST_TIME} s (32 years)", "$slowest s")
        }
        return mission
    }
}
