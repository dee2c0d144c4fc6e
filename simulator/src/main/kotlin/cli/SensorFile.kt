package stillwater.cli

import stillwater.io.JsonFile
import stillwater.io.JsonFileProblem
import stillwater.sensor.SensorSpec
import java.nio.file.Path

/** Reads the file that `--sensor` names. */
internal object SensorFile {
    /** The spec in [file]; a [BadFlag] says in one line what is wrong with it. */
    fun read(file: String): SensorSpec = try {
        JsonFile("a sensor spec (JSON)", LONGEST_SPEC).read(Path.of(file), SensorSpec::fromJson)
    } catch (problem: JsonFileProblem) {
        throw BadFlag("--sensor", problem)
    }

    private const val LONGEST_SPEC = 1_000_000
}
