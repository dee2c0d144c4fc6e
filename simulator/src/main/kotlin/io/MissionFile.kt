package stillwater.io

import stillwater.mission.MissionSpec
import java.nio.file.Path

/** Reads the file of a mission. */
object MissionFile {
    private val FILE = JsonFile("a mission (JSON)")

    /**
     * The mission in [file].
     *
     * @throws JsonFileProblem if there is none.
     */
    fun read(file: Path): MissionSpec = FILE.read(file, MissionSpec::fromJson)

    /** The mission in [text], which messages call [name]; throws as [read] does. */
    fun parse(text: String, name: String): MissionSpec = FILE.parse(text, name, MissionSpec::fromJson)
}
