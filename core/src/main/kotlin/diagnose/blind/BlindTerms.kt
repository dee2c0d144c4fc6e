package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.response.Term
import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.sqrt

/** The causes that are tried on a log without a reference. */
internal object BlindTerms {
    private const val EVEN = 0.03
    private const val LEAST_WARMTH = 0.05
    private const val COARSE = 0.3

    /** Other shapes of a lag. */
    val OF_LAG = setOf(
        Cause.SECOND_ORDER_RESPONSE,
        Cause.TWO_PATH_RESPONSE,
        Cause.DEAD_TIME,
        Cause.POSITION_OFFSET,
    )

    /**
     * All that the log may show; of a lag's shape only where it [hasShape], but for a slow path, which lasts for far longer
     * than a lag of either kind, and a place, which may be ahead as no lag is.
     */
    fun of(search: BlindSearch, hasShape: Boolean): List<Term> = buildList {
        add(Term(Cause.ASYMMETRIC_RESPONSE))
        add(Term(Cause.TWO_PATH_RESPONSE))
        if (hasShape) {
            add(Term(Cause.SECOND_ORDER_RESPONSE))
            add(Term(Cause.DEAD_TIME))
        }
        add(Term(Cause.SLEW_LIMIT))
        val scales = search.scales
        val spread = sqrt(scales.logSpeed.map { it * it }.average())
        if (spread > EVEN) add(Term(Cause.FLOW_DEPENDENT_RESPONSE))
        if (scales.warmth.any { abs(it) > LEAST_WARMTH }) add(Term(Cause.TEMPERATURE_DEPENDENT_RESPONSE))
        for ((name, column) in scales.centred) {
            if (name != Conditions.HEADING && column.any { it != 0.0 }) add(Term(Cause.CROSS_SENSITIVITY, name))
        }
        add(Term(Cause.DRIFT))
        add(Term(Cause.OFFSET_STEPS))
        add(Term(Cause.HYSTERESIS))
        val noise = sqrt(search.lastVariance)
        if (scales.resolution > COARSE * noise) add(Term(Cause.QUANTISATION))
        add(Term(Cause.SATURATION))
        if (spread > EVEN) add(Term(Cause.POSITION_OFFSET))
    }

    /**
     * What is tried on top of [state], by [tries]; nothing between a time constant and a dead time where [isShapeOpen]. Where fixes
     * are far off other shapes of a lag are not, but that a place which is behind them, surer than [level], may be a dead
     * time: that makes nothing smoother than a lag alone does, as changes of the water that the boat did not see would.
     */
    fun on(
        state: BlindState,
        search: BlindSearch,
        tries: BlindTrials,
        isShapeOpen: Boolean,
        level: Double,
    ): List<Term> {
        val areFar = search.fixes.areFar(state)
        val terms = of(search, !isShapeOpen && !areFar).filter { new -> state.model.terms.none { it.key == new.key } }
        val place = terms.firstOrNull { areFar && !isShapeOpen && it.cause == Cause.POSITION_OFFSET }
        val isBehind = place != null && tries.attempt(place).let { it.isLate && it.pValue < level }
        return if (isBehind) terms + Term(Cause.DEAD_TIME) else terms
    }

    /**
     * Whether [term], as [found] has it, makes readings late by less than so many [rows]: the smoothed way itself is off by
     * a tenth, which explains a little.
     */
    fun isLittle(term: Term, found: BlindState, rows: Double = SmallShifts.LEAST_ROWS): Boolean {
        val late = SmallShifts.late(term, found.model, found.numbers) ?: return false
        return abs(late) < rows * found.model.series.period
    }
}
