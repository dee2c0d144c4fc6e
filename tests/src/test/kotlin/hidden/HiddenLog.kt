package stillwater.hidden

import java.nio.file.Files
import java.nio.file.Path

/**
 * `SEED reference|blind DIRECTORY`: writes the log of one case, and the sensor as it is believed to be where the case
 * gives one, and prints what is hidden; for work on the finder.
 */
fun main(arguments: Array<String>) {
    val case = HiddenCase(arguments[0].toLong(), arguments[1] == "reference")
    val directory = Files.createDirectories(Path.of(arguments[2]))
    case.write(directory.resolve("log.csv"))
    case.writeSensor(directory.resolve("believed.json"))
    println(case.truth)
}
