package stillwater.hidden

import kotlin.math.abs

/** A case and the finder's answer to it. */
internal class ScoredCase(
    val seed: Long,
    val truth: HiddenTruth,
    val answer: FinderAnswer,
    private val leftByTruth: Double,
) {
    private val listed = truth.effects.keys.filter { it.listed }

    /** What only a reference could tell apart is no alarm: a lag is there, of one kind or the other. */
    private val claims = answer.sets.filter { it.toSet() != RESPONSE }

    val isEmpty: Boolean get() = truth.effects.isEmpty()
    val isOutside: Boolean get() = truth.effects.keys.any { !it.listed }
    val isSingle: Boolean get() = listed.size == 1 && !isOutside
    val isDouble: Boolean get() = listed.size == 2

    /** Strength over the detectable one. */
    val multiple: Double get() = truth.multiples.values.firstOrNull() ?: 0.0

    /** Whether the answer says that anything is wrong. */
    val alarmed: Boolean get() = claims.isNotEmpty() || answer.verdict == "unexplained"

    /** Whether a single effect is named, alone or in a set of two, and nothing else is. */
    val correct: Boolean
        get() {
            val label = listed.single().label
            val own = answer.sets.filter { label in it && it.size <= 2 }
            return own.isNotEmpty() && claims.all { label in it }
        }

    /** Whether both of two effects are in the answer. */
    val bothFound: Boolean get() = listed.all { effect -> answer.sets.any { effect.label in it } }

    /** Whether something of the list is claimed. */
    val named: Boolean get() = claims.isNotEmpty() && answer.verdict != "unexplained"

    /** The relative error of the effect's own number where it is comparable; NaN otherwise. */
    val numberError: Double
        get() {
            val effect = listed.singleOrNull() ?: return Double.NaN
            val name = NUMBERS[effect] ?: return Double.NaN
            val found = answer.numbers[effect.label]?.entries?.firstOrNull { it.key.startsWith(name) }?.value
            val hidden = truth.numbers.getValue(effect)
            // Which of two lags in a row is the first does not show.
            val comparable = if (effect == HiddenEffect.SECOND_ORDER) minOf(hidden, truth.timeConstant) else hidden
            return abs((found ?: return Double.NaN) / comparable - 1)
        }

    /** What the answer gained in held-out mean square, over the noise's variance; nothing where nothing was named. */
    val gain: Double
        get() = if (answer.after.isNaN()) {
            0.0
        } else {
            (answer.before * answer.before - answer.after * answer.after) / (truth.noise * truth.noise)
        }

    /** What a model with the true numbers gains on the same readings, in the same units; NaN where none is asked for. */
    val possibleGain: Double
        get() = (answer.before * answer.before - leftByTruth * leftByTruth) / (truth.noise * truth.noise)

    /** The answer in few words. */
    val said: String
        get() = when {
            claims.isEmpty() -> answer.verdict
            else -> claims.joinToString(" + ") { it.joinToString("/") }
        }

    /** The case as a line of [COLUMNS], tabs between. */
    fun line(): String = listOf(
        seed,
        truth.track,
        truth.effects.keys.joinToString("+") { it.label }.ifEmpty { "none" },
        "%.2f".format(multiple),
        answer.verdict,
        said,
        "%.3f".format(gain),
        "%.3f".format(possibleGain),
        "%.3f".format(numberError),
    ).joinToString("\t")

    companion object {
        /** What [line] holds. */
        const val COLUMNS = "seed\ttrack\thidden\tmultiple\tverdict\tsaid\tgain\tpossible_gain\tnumber_error"
        private val RESPONSE = setOf("time-constant", "dead-time")
        private val NUMBERS = mapOf(
            HiddenEffect.TIME_CONSTANT to "time_constant_s",
            HiddenEffect.GAIN_OFFSET to "gain",
            HiddenEffect.TIME_VARYING to "rate_per_s",
            HiddenEffect.DEAD_TIME to "dead_time_s",
            HiddenEffect.SECOND_ORDER to "second_time_constant_s",
            HiddenEffect.ASYMMETRIC to "log_ratio",
            HiddenEffect.FLOW to "exponent",
            HiddenEffect.TEMPERATURE to "relative_change_per_deg_c",
            HiddenEffect.POSITION to "behind_m",
            HiddenEffect.TWO_PATH to "slow_share",
            HiddenEffect.SLEW to "rate_per_s",
            HiddenEffect.CROSS to "coefficient of salinity",
            HiddenEffect.DRIFT to "rate_per_s",
            HiddenEffect.STEPS to "jump_1",
            HiddenEffect.HYSTERESIS to "width",
            HiddenEffect.SATURATION to "upper",
        )
    }
}

/** Least gain in held-out mean square, over the noise's variance, that is asked for: a fifth of 1x in a long log. */
private const val LEAST_POSSIBLE = 0.01

/** Verdicts that name nothing and do not say that all is well. */
private val UNNAMED = setOf("unexplained", "insufficient-data")

/** Counts over many cases, as text for docs/diagnosis.md. */
internal class Scores(private val cases: List<ScoredCase>) {
    private fun share(of: List<ScoredCase>, holds: (ScoredCase) -> Boolean): String {
        val hits = of.count(holds)
        return if (of.isEmpty()) "none drawn" else "$hits of ${of.size} (${Math.round(100.0 * hits / of.size)} %)"
    }

    private fun median(of: List<Double>) = of.sorted().let { if (it.isEmpty()) Double.NaN else it[it.size / 2] }

    private fun percent(share: Double) = if (share.isNaN()) "-" else "${Math.round(100 * share)} %"

    /** False alarms over the cases without an effect, dimensionless. */
    val falseAlarms: Double get() = cases.filter { it.isEmpty }.let { c ->
        c.count { it.alarmed } /
            maxOf(c.size, 1).toDouble()
    }

    /** Share of single effects at the detectable size or above that are named, dimensionless. */
    val correct: Double
        get() = cases.filter { it.isSingle && it.multiple >= 1 }.let { c ->
            c.count { it.correct } /
                maxOf(c.size, 1).toDouble()
        }

    /** The bars' table, the power curves and the confusability matrix, Markdown. */
    fun markdown(): String = buildString {
        val single = cases.filter { it.isSingle }
        val strong = single.filter { it.multiple >= 1 }
        appendLine("| what | result |\n| --- | --- |")
        appendLine("| false alarms on no-effect cases | ${share(cases.filter { it.isEmpty }) { it.alarmed }} |")
        appendLine("| cause correct, or in a set of two, at 1x and above | ${share(strong) { it.correct }} |")
        appendLine(
            "| two effects at 2x: both in the answer | ${share(
                cases.filter {
                    it.isDouble && it.multiple >= 2
                },
            ) { it.bothFound }} |",
        )
        val outside = cases.filter { it.isOutside && it.multiple >= 1 }
        appendLine(
            "| outside the list, 1x and above: unexplained or insufficient | ${share(outside) {
                !it.named && it.answer.verdict in UNNAMED
            }} |",
        )
        appendLine("| outside the list, 1x and above: a wrong name | ${share(outside) { it.named }} |")
        val numbers = single.filter { it.multiple >= 2 && it.correct && it.numberError.isFinite() }
        appendLine(
            "| number of the named cause within 10 % at 2x and above | ${share(numbers) { it.numberError < 0.1 }}; " +
                "median error ${percent(median(numbers.map { it.numberError }))} |",
        )
        // An effect that leaves no more to gain than that is not worth a share of it.
        val gains = strong.filter { it.possibleGain > LEAST_POSSIBLE }
        appendLine(
            "| held-out gain over the true model's, all single effects at 1x and above | " +
                "${percent(
                    gains.sumOf {
                        minOf(it.gain, it.possibleGain)
                    } / gains.sumOf { it.possibleGain },
                )} (median of " +
                "${gains.size} cases ${percent(median(gains.map { it.gain / it.possibleGain }))}; at least 85 % in " +
                "${share(gains) { it.gain >= 0.85 * it.possibleGain }}; ${strong.size - gains.size} left out) |",
        )
        val lags = cases.filter { it.isEmpty && it.answer.timeConstant != null }
        appendLine(
            "| interval of 95 % of the time constant holds it, no-effect cases | ${share(lags) {
                it.truth.timeConstant in checkNotNull(it.answer.timeConstant)
            }} |",
        )
        appendLine("\nPower: share of single effects named correctly, by strength over the detectable size.\n")
        appendLine("| cause | 0.25 to 0.5 | 0.5 to 1 | 1 to 2 | 2 to 4 |\n| --- | --- | --- | --- | --- |")
        for (effect in HiddenEffect.entries.filter { it.listed }) {
            val own = single.filter { effect in it.truth.effects }
            val cells = listOf(0.25 to 0.5, 0.5 to 1.0, 1.0 to 2.0, 2.0 to 4.01).joinToString(" | ") { (from, to) ->
                own.filter {
                    it.multiple >= from && it.multiple < to
                }.let { c -> "${c.count { it.correct }}/${c.size}" }
            }
            appendLine("| ${effect.label} | $cells |")
        }
        appendLine("\nConfusability: what was said of single effects at 1x and above, where not the effect alone.\n")
        appendLine("| hidden | said | cases |\n| --- | --- | --- |")
        strong.groupBy { it.truth.effects.keys.single().label to it.said }.filter { it.key.first != it.key.second }
            .toList().sortedWith(compareBy({ it.first.first }, { -it.second.size }))
            .forEach { (key, of) -> appendLine("| ${key.first} | ${key.second} | ${of.size} |") }
        appendLine(
            "\nFalse alarms: " +
                cases.filter { it.isEmpty && it.alarmed }.joinToString { "${it.seed} (${it.said})" }.ifEmpty { "none" },
        )
    }
}
