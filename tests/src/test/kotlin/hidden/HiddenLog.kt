package stillwater.hidden

import java.nio.file.Files
import java.nio.file.Path

/**
 * `SEED REGIME DIRECTORY`: writes the log of one case in one of the [Regime]s, and the sensor as it is believed to be
 * where the case gives one, and prints what is hidden; for work on the finder.
 */
fun main(arguments: Array<String>) {
    val case = Regime.of(arguments[1]).case(arguments[0].toLong())
    val directory = Files.createDirectories(Path.of(arguments[2]))
    case.write(directory.resolve("log.csv"))
    case.writeSensor(directory.resolve("believed.json"))
    println(case.truth)
    case.conditions?.let { println("In the field: $it") }
}
