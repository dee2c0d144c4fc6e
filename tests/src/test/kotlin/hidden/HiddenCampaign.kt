package stillwater.hidden

import java.nio.file.Files
import java.nio.file.Path

/** Runs seeds of the sealed generator through the finder; see docs/diagnosis.md for the command. */
internal object HiddenCampaign {
    /**
     * The scored cases of [seeds], with logs and results in [directory].
     *
     * @param withGain whether what could be gained is found too: without a reference that takes as long as the rest.
     */
    fun run(
        seeds: Iterable<Long>,
        regime: Regime,
        directory: Path,
        withGain: Boolean = true,
        told: (ScoredCase) -> Unit = {},
    ): List<ScoredCase> =
        seeds.map { seed ->
            val case = regime.case(seed)
            val log = directory.resolve("log.csv")
            case.write(log)
            val sensor = directory.resolve("believed.json").takeIf { case.writeSensor(it) }
            val answer = Finder.ask(log, regime.withReference, directory.resolve("out"), sensor)
            val left = when {
                regime.withReference -> case.leftByTruth
                withGain -> leftWithoutEffect(seed, case.truth, regime, directory)
                else -> Double.NaN
            }
            ScoredCase(seed, case.truth, answer, left).also(told)
        }

    /**
     * What the true model would leave held out of a log without a reference, where the water is unknown to it as well:
     * what the base leaves of the same log without the effect, noise and fixes the same. NaN where that is not asked
     * for: of weak effects, and of those that no model of the reading foretells (outliers; rounding, whose phase the
     * unknown water and the fixes hide).
     */
    private fun leftWithoutEffect(seed: Long, truth: HiddenTruth, regime: Regime, directory: Path): Double {
        if (!truth.isStrong || truth.effects.keys.single() in UNFORESEEN) return Double.NaN
        val log = directory.resolve("twin.csv")
        regime.case(seed, isTwin = true).write(log)
        return Finder.ask(log, withReference = false, directory.resolve("out-twin")).before
    }

    private val UNFORESEEN = setOf(HiddenEffect.OUTLIERS, HiddenEffect.QUANTISATION)
}

/** After so many cases the tables so far are written beside the table of cases. */
private const val OFTEN = 10

/** Cases by what they hide, so that a few of one kind need no campaign of all. */
private val KINDS = mapOf<String, (HiddenTruth) -> Boolean>(
    "strong" to { it.isStrong },
    "outside" to { truth -> truth.effects.keys.any { !it.listed } },
    "none" to { it.effects.isEmpty() },
    "two" to { it.effects.size == 2 && it.multiples.values.min() >= 2 },
) + HiddenEffect.entries.map { effect -> effect.label to { truth -> truth.isStrong && effect in truth.effects } }

/**
 * `FIRST COUNT REGIME [CASES.tsv] [strong|two|outside|none|LABEL]`: prints the tables of a campaign in one of the
 * [Regime]s; CASES.tsv gets a line a case, CASES.tsv.md the tables so far. With the last word only some cases are asked
 * about: single effects at the detectable size and above, two at twice theirs and above, effects outside the list, or
 * none; with the label of an effect of the list those that are this one alone, at the detectable size and above.
 */
fun main(arguments: Array<String>) {
    val first = arguments[0].toLong()
    val regime = Regime.of(arguments[2])
    val directory = Files.createTempDirectory("hidden-effects")
    val all = (first until first + arguments[1].toLong()).toList()
    val kind = KINDS[arguments.last()]
    // To draw a case takes half a second.
    val seeds = if (kind == null) all else all.parallelStream().filter { kind(regime.case(it).truth) }.toList()
    val table = arguments.getOrNull(3)?.takeIf { it !in KINDS }?.let { Path.of(it) }
    val lines = ArrayList<String>()
    val done = ArrayList<ScoredCase>()
    val cases = HiddenCampaign.run(seeds, regime, directory) { case ->
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
