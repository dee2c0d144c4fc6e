package stillwater.hidden

import java.nio.file.Files
import java.nio.file.Path

/** Runs seeds of the sealed generator through the finder; see docs/diagnosis.md for the command. */
internal object HiddenCampaign {
    /** The scored cases of [seeds], with logs and results in [directory]. */
    fun run(
        seeds: LongRange,
        withReference: Boolean,
        directory: Path,
        told: (ScoredCase) -> Unit = {},
    ): List<ScoredCase> =
        seeds.map { seed ->
            val case = HiddenCase(seed, withReference)
            val log = directory.resolve("log.csv")
            case.write(log)
            ScoredCase(seed, case.truth, Finder.ask(log, withReference, directory.resolve("out"))).also(told)
        }
}

/** `FIRST COUNT reference|blind`: prints the table of a campaign. */
fun main(arguments: Array<String>) {
    val first = arguments[0].toLong()
    val directory = Files.createTempDirectory("hidden-effects")
    val seeds = first until first + arguments[1].toLong()
    val cases = HiddenCampaign.run(seeds.first..seeds.last, arguments[2] == "reference", directory) { case ->
        val effects = case.truth.effects.keys.joinToString("+") { it.label }.ifEmpty { "none" }
        System.err.println(
            "${case.seed} ${case.truth.track} $effects %.2fx: ${case.answer.verdict} ${case.said}".format(
                case.multiple,
            ),
        )
    }
    println(Scores(cases).markdown())
    directory.toFile().deleteRecursively()
}
