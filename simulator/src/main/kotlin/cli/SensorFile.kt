package stillwater.cli

import stillwater.estimate.UndoableSensor
import stillwater.estimate.UnfitStage
import stillwater.io.JsonFile
import stillwater.io.JsonFileProblem
import stillwater.sensor.SensorSpec
import java.nio.file.Path

/** Reads the file that `--sensor` names. */
internal object SensorFile {
    /** The spec in [file]; a [BadFlag] says in one line what is wrong with it. */
    fun read(file: String): SensorSpec = read(file, SensorSpec::fromJson)

    /** As [read], of a sensor whose response is to be undone; a [BadFlag] says which stage cannot be. */
    fun readUndoable(file: String): SensorSpec = read(file) { text ->
        val spec = SensorSpec.fromJson(text)
        try {
            UndoableSensor.of(spec)
        } catch (unfit: UnfitStage) {
            throw SensorSpec.problem(text, unfit.index, "a stage that can be undone", unfit.message.orEmpty())
        }
        spec
    }

    /** That the sensor in [file], each stage of which can be undone, cannot be on a log: [wrong]. */
    fun unfit(file: String?, wrong: IllegalArgumentException) =
        BadFlag("--sensor: $file", "a sensor that can be undone on this log", wrong.message.orEmpty())

    private fun read(file: String, parse: (String) -> SensorSpec): SensorSpec = try {
        JsonFile("a sensor spec (JSON)", LONGEST_SPEC).read(Path.of(file), parse)
    } catch (problem: JsonFileProblem) {
        throw BadFlag("--sensor", problem)
    }

    private const val LONGEST_SPEC = 1_000_000
}
