package stillwater.survey

import stillwater.estimate.SensorBelief
import stillwater.estimate.SensorCandidate
import stillwater.estimate.SensorStanding
import stillwater.survey.Wording.Companion.digits

/**
 * What a self-calibrating estimator believes of its sensor, in words.
 *
 * @param belief the belief.
 */
internal class SensorWording(private val belief: SensorBelief) {
    /** Names and sentences: the chosen model, then what the readings say of the others. */
    val facts: List<Pair<String, String>> = buildList {
        add("sensor model" to chosen())
        undecided()?.let { add("not decided" to it) }
        of(SensorStanding.NOT_NEEDED)?.let { add("not needed" to it) }
        of(SensorStanding.EXCLUDED)?.let { add("excluded" to it) }
        val untried = belief.candidates.filter { it.standing == SensorStanding.NOT_TRIED }
        if (untried.isNotEmpty()) add("not tried" to untried.joinToString { it.kind.label } + ": nothing asked for it")
    }

    private fun chosen(): String {
        val chosen = belief.chosen
        return if (belief.isExplained) {
            "${chosen.kind.label}, ${parameters(chosen)}"
        } else {
            val unlike = unlikeItsCells(belief)
            val why = unlike?.let { "none can be learned in these cells, $it" } ?: "none explains the readings"
            val more = if (unlike == null) "" else " and of the readings' spread"
            "$why: bounds are those of bounded-extended$more; ${chosen.kind.label} comes closest, with " +
                chosen.parameters.joinToString { "${it.name} ${digits(it.value)}" }
        }
    }

    private fun undecided(): String? {
        val undecided = belief.undecided
        if (undecided.isEmpty()) return null
        if (belief.isExplained) {
            val others = undecided.joinToString("; ") { "${it.kind.label}, ${parameters(it)}" }
            return "$others: about as likely; the bounds hold what either says"
        }
        if (unlikeItsCells(belief) !=
            null
        ) {
            return "between a time constant, a dead time and the others: odds mean nothing here"
        }
        val others = undecided.joinToString { "${it.kind.label} ${digits(it.evidence)}" }
        return "between a time constant, a dead time and the others, as long as none explains the readings; log odds " +
            "against them: $others"
    }

    private fun of(standing: SensorStanding): String? {
        val candidates = belief.candidates.filter { it.standing == standing }
        if (candidates.isEmpty()) return null
        return candidates.joinToString("; ") { candidate ->
            val numbers = if (standing == SensorStanding.NOT_NEEDED) " (${parameters(candidate)})" else ""
            "${candidate.kind.label}$numbers, log odds against it ${digits(candidate.evidence)}"
        }
    }

    private fun parameters(candidate: SensorCandidate) = candidate.parameters.joinToString {
        "${it.name} ${digits(it.value)} (95 %: ${digits(it.interval.lower)} to ${digits(it.interval.upper)})"
    }

    companion object {
        /** Why a sensor cannot be learned from readings in cells that [belief] finds not to be as they should; or null. */
        fun unlikeItsCells(belief: SensorBelief): String? = when {
            !belief.areCellsEven -> "because nothing shows that the water changes at their borders and not within them"
            !belief.isWaterSteady ->
                "because their water changed between one visit and another, or fixes are off or late"
            else -> null
        }
    }
}
