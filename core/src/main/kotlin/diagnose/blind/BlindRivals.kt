package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.response.Term
import stillwater.model.Conditions
import kotlin.math.exp

/** Which causes may be meant by what was named. */
internal object BlindRivals {
    /** Student's t with 23 degrees of freedom, one-sided 5 %. */
    private const val AGREED = 1.71

    /** Twice a difference of log-likelihoods over inflation, odds of 150 to 1, of which stretches are not asked. */
    private const val FAR = 10.0

    /**
     * Whether what [term] shows may as well be the water's own where nobody knows the water: a change of the
     * sensor's offset is like one of all the water, and what else is measured in the water may go with the value
     * there, so that where the water changed between two passes both changed. Speed and heading are the boat's.
     */
    fun mayBeWaters(term: Term): Boolean = term.cause in BlindDiagnosis.SLOW ||
        (term.cause == Cause.CROSS_SENSITIVITY && term.condition !in setOf(Conditions.SPEED, Conditions.HEADING))

    /**
     * The causes among [rivals] that with [own] make the smallest set that holds the right one with [probability]
     * or more, each as likely before, as where there is a reference: core/docs/Diagnosis.md, (6).
     */
    fun alike(own: BlindTrial, probability: Double, rivals: List<BlindTrial>): List<Cause> {
        val others = rivals.filter { it.name != own.name }.sortedByDescending { it.likelier }
        val odds = others.map { exp(minOf((it.likelier - own.likelier) / (2 * own.inflation), 0.0)) }
        val total = 1 + odds.sum()
        var covered = 1.0
        val set = ArrayList<Cause>()
        others.forEachIndexed { i, rival ->
            val isOpen = covered < probability * total || !isBehind(rival, own)
            if (isOpen) set += checkNotNull(rival.term).cause
            covered += odds[i]
        }
        return set
    }

    /**
     * Whether [own] is far likelier than [rival], or stretches of the log agree that it is likelier: noise that is not
     * what its model says makes differences of likelihood of itself. What acts at one moment, as a jump does, differs
     * from the rest in few stretches, so that they are not asked about changes with time.
     */
    private fun isBehind(rival: BlindTrial, own: BlindTrial): Boolean {
        if (own.term?.cause in BlindDiagnosis.SLOW) return true
        val worse = rival.state ?: return true
        val better = own.state ?: return true
        return (own.likelier - rival.likelier) / own.inflation > FAR ||
            BlindEvidence.between(worse, better) > AGREED
    }
}
