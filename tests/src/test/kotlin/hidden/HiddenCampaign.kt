package stillwater.hidden

import java.nio.file.Files
import java.nio.file.Path

/** Runs seeds of the sealed generator through the finder; see docs/diagnosis.md for the command. */
internal object HiddenCampaign {
    /** The scored cases of [seeds], with logs and results in [directory]. */
    fun run(
        seeds: Iterable<Long>,
        withReference: Boolean,
        directory: Path,
        told: (ScoredCase) -> Unit = {},
    ): List<ScoredCase> =
        seeds.map { seed ->
            val case = HiddenCase(seed, withReference)
            val log = directory.resolve("log.csv")
            case.write(log)
            val sensor = directory.resolve("believed.json").takeIf { case.writeSensor(it) }
            val answer = Finder.ask(log, withReference, directory.resolve("out"), sensor)
            ScoredCase(seed, case.truth, answer, case.leftByTruth).also(told)
        }
}

/** After so many cases the tables so far are written beside the table of cases. */
private const val OFTEN = 10

/** Cases by what they hide, so that a few of one kind need no campaign of all. */
private val KINDS = mapOf<String, (HiddenTruth) -> Boolean>(
    "strong" to { it.isStrong },
    "outside" to { truth -> truth.effects.keys.any { !it.listed } },
    "none" to { it.effects.isEmpty() },
)

/**
 * `FIRST COUNT reference|blind [CASES.tsv] [strong|outside|none]`: prints the tables of a campaign; CASES.tsv gets a
 * line a case, CASES.tsv.md the tables so far. With the last word only single effects at the detectable size and above,
 * effects outside the list, or cases without an effect are asked about.
 */
fun main(arguments: Array<String>) {
    val first = arguments[0].toLong()
    val withReference = arguments[2] == "reference"
    val directory = Files.createTempDirectory("hidden-effects")
    val all = first until first + arguments[1].toLong()
    val kind = KINDS[arguments.last()]
    val seeds = if (kind != null) all.filter { kind(HiddenCase(it, withReference).truth) } else all.toList()
    val table = arguments.getOrNull(3)?.takeIf { it !in KINDS }?.let { Path.of(it) }
    val lines = ArrayList<String>()
    val done = ArrayList<ScoredCase>()
    val cases = HiddenCampaign.run(seeds, withReference, directory) { case ->
        lines += case.line()
        System.err.println(lines.last())
        done += case
        table?.let { Files.write(it, listOf(ScoredCase.COLUMNS) + lines) }
        if (table != null && done.size % OFTEN == 0) {
            Files.writeString(table.resolveSibling("${table.fileName}.md"), Scores(done).markdown())
        }
    }
    println(Scores(cases).markdown())
    directory.toFile().deleteRecursively()
}
