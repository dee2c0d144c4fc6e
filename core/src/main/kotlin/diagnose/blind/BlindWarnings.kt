package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.Dependence
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.evidence.CoarseRounding
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.evidence.StillReadings
import stillwater.diagnose.evidence.Structure
import stillwater.diagnose.response.Steps
import stillwater.diagnose.three

/** What a reader must know beside the verdict of a log without a reference. */
internal class BlindWarnings(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val search: BlindSearch,
    private val last: BlindState,
    private val lag: BlindLag,
    private val outliers: BlindOutliers,
    private val given: GivenLag?,
) {
    /** In words, beside [verdict]; [left] is the strongest of what is left, [rounding] what is coarse, [still] what may be. */
    fun of(
        left: Dependence,
        verdict: Verdict,
        rounding: CoarseRounding?,
        still: StillReadings,
    ): List<String> = buildList {
        val isNamed = verdict is Verdict.Named || verdict is Verdict.Ambiguous
        if (given?.isPartial == true) {
            val what = if (given.state == null) {
                "was not used: without a reference a lag is fitted in its place"
            } else {
                "was looked at for its time constant alone, because there is no reference"
            }
            add("The sensor given $what.")
        }
        if (given != null && given.delay > 0) {
            add(
                "The dead time of the sensor given, ${three(given.delay)} s, was taken as right: places are those of " +
                    "so long before, and a dead time that is named holds it; how the readings lag is told beside it.",
            )
        }
        add(
            "No reference: the water was inferred from revisits with ${search.modes.size} numbers, as fine as " +
                "${three(search.modes.finest)} ${series.placeUnit}; a gain or an offset cannot be seen. Errors on " +
                "held-out blocks are those of a forecast from other passes and the rows before.",
        )
        if (lag.isSeen) addAll(ofLag(verdict))
        if (search.steps == Steps.UNTIL_NEXT) add(SmallShifts.UNTIL_NEXT)
        if (!last.isResolved) {
            add(
                "The water has finer structure than these numbers show, or the response another shape: the interval " +
                    "of the lag may be too narrow.",
            )
        }
        if (isNamed && left.adjusted < settings.structureLevel) {
            add("Structure is left beside what was named: the residuals depend on ${left.description}.")
        }
        last.model.terms.filter { it.cause == Cause.CROSS_SENSITIVITY && BlindRivals.mayBeWaters(it) }.forEach {
            add(
                "The ${it.condition} may go with the value in the water itself: water that changed between two " +
                    "passes looks like a sensor that also shows it.",
            )
        }
        last.averaged?.sentenceBeside(verdict)?.let(::add)
        addAll(listOfNotNull(search.fixes.words(last), rounding?.words(), search.gaps?.words()))
        still.repeats()?.let(::add)
        val off = outliers.rows.size
        if (off > 0) add("${Spikes.words(off)} and left out of the fits.")
    }

    /** What the log says of a lag, which is seen, alone. */
    private fun ofLag(verdict: Verdict): List<String> = buildList {
        // Whether the answer is of a lag of one kind, or of either, and of nothing else.
        val isAlone = verdict !is Verdict.Named &&
            last.model.terms.all { it.cause == Cause.DEAD_TIME && !lag.isNeitherAlone }
        val by = if (isAlone) "by " else ""
        val tau = three(lag.timeConstant.timeConstant)
        add(
            (if (isAlone) "The readings lag the water " else "A lag alone would be ") +
                "$by$tau s as a first-order lag, or $by${three(lag.delay)} s as a dead time" +
                when {
                    lag.isDeadTime -> ", which explains more."
                    lag.isOpen(settings.separation) || lag.preference <= 0 -> "."
                    else -> ", which explains less."
                },
        )
        add(
            "The correction of a track (correct) compares passes over the same place alone, without a model of " +
                "the water between them: its lag may differ, and where it is outside of the interval here, " +
                "neither should be relied on.",
        )
    }
}
