package stillwater.correct

import stillwater.survey.LegMismatch

/**
 * How far successive passes of a transect differ that the sensor was not learned on, root mean square.
 *
 * @property pairs pairs of passes compared. @property before as measured, sensor units. @property after as corrected.
 * @property smoothed as the same smoother leaves them without undoing a lag, sensor units; NaN where it was not run.
 */
data class HeldOutPasses(
    val pairs: Int,
    val before: Double,
    val after: Double,
    val smoothed: Double = Double.NaN,
)

/**
 * How far opposite legs differ that the sensor was not learned on.
 *
 * @property learnedOn legs it was learned on, in words. @property legs number of legs scored.
 * @property before mean mismatch of these legs as measured, sensor units. @property after as corrected, sensor units.
 * @property smoothed as the same smoother leaves them without undoing a lag, sensor units; NaN where it was not run:
 * what [after] is less than this is the lag's part of the gain, the rest is that noise was smoothed.
 * @property passes the same legs, each against the next one; null where they are not passes of one transect.
 */
data class HeldOutScore(
    val learnedOn: String,
    val legs: Int,
    val before: Double,
    val after: Double,
    val passes: HeldOutPasses? = null,
    val smoothed: Double = Double.NaN,
) {
    /** What of the mismatch went by smoothing and by undoing the lag, a share of [before]; negative where it grew. */
    val gain: Double get() = 1 - after / before

    /** What of the mismatch went by undoing the lag, a share of [smoothed]; negative where it grew. */
    val lagGain: Double get() = 1 - after / smoothed
}

/** The [legs] with the [values] that a correction gives, one a reading. */
internal class CorrectedLegs(val legs: LegMismatch, val values: DoubleArray)

/**
 * Learns the sensor on some legs of a log and scores the correction on the others: on halves, whose scored legs and
 * neighbours are all unseen, and on every other pair of legs, whose scored legs have neighbours that were seen.
 *
 * @param original the legs as measured. @param smoothed the legs smoothed with no lag undone, or null.
 * @param passes the difference of successive legs of a transect, or null.
 * @param correct what the legs become when the sensor is learned on these rows alone; null where they teach nothing.
 */
internal class HeldOutLegs(
    private val original: CorrectedLegs,
    private val passes: PassDifference? = null,
    private val smoothed: CorrectedLegs? = null,
    private val correct: (List<Int>) -> CorrectedLegs?,
) {
    private val measured = original.legs
    private val count = measured.legs.legs.size

    /** The scores of the splits that have legs to score; empty for fewer than [FEWEST] legs. */
    fun scores(): List<HeldOutScore> {
        if (count < FEWEST) return emptyList()
        val half = count / 2
        return listOfNotNull(
            score("the first half", learned = { it < half }, scored = { it > half && it < count - 1 }),
            score("the second half", learned = { it >= half }, scored = { it in 1 until half - 1 }),
            score("odd pairs", learned = { it / 2 % 2 == 0 }, scored = { it / 2 % 2 == 1 }),
            score("even pairs", learned = { it / 2 % 2 == 1 }, scored = { it / 2 % 2 == 0 }),
        )
    }

    private fun score(words: String, learned: (Int) -> Boolean, scored: (Int) -> Boolean): HeldOutScore? {
        val corrected = correct(rows(learned)) ?: return null
        val after = corrected.legs.scores.associate { it.number to it.opposite }
        val both = measured.scores.filter { scored(it.number - 1) && it.number in after }
        if (both.isEmpty()) return null
        return HeldOutScore(
            words,
            both.size,
            both.sumOf { it.opposite } / both.size,
            both.sumOf { after.getValue(it.number) } / both.size,
            passes?.let { passes(it, (0 until count - 1).filter { i -> !learned(i) && !learned(i + 1) }, corrected) },
            smoothed(both.map { it.number }),
        )
    }

    /** Mean mismatch of the legs with these [numbers], smoothed with no lag undone. */
    private fun smoothed(numbers: List<Int>): Double {
        val found = smoothed?.legs?.scores?.filter { it.number in numbers }.orEmpty()
        return if (found.size == numbers.size) found.sumOf { it.opposite } / found.size else Double.NaN
    }

    /** Of the pairs of legs in which neither was learned on. */
    private fun passes(difference: PassDifference, firsts: List<Int>, corrected: CorrectedLegs) = HeldOutPasses(
        firsts.size,
        difference.of(original.values, firsts),
        difference.of(corrected.values, firsts),
        smoothed?.let { difference.of(it.values, firsts) } ?: Double.NaN,
    ).takeIf { it.before.isFinite() && it.after.isFinite() }

    /** Rows of the legs that [isIn] takes, and of the turns between two of them. */
    private fun rows(isIn: (Int) -> Boolean): List<Int> {
        val legs = measured.legs.legs
        return legs.indices.filter(isIn).flatMap { i ->
            val next = if (i + 1 < count && isIn(i + 1)) legs[i + 1].first - 1 else legs[i].last
            legs[i].first..next
        }
    }

    companion object {
        /** Legs below which halves have too few to learn on and to score. */
        const val FEWEST = 8
    }
}
