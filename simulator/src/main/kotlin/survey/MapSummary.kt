package stillwater.survey

import stillwater.report.counted
import stillwater.run.FilterKind
import stillwater.survey.Wording.Companion.digits
import stillwater.survey.Wording.Companion.duration
import stillwater.survey.Wording.Companion.percent

/**
 * What a [SurveyMap] comes to in words and rounded numbers, for the terminal and the report.
 *
 * @param map the map.
 */
class MapSummary(private val map: SurveyMap) {
    private val statistics = map.statistics
    private val wording = Wording(map)

    /** The quantity, with its unit where the user gave one. */
    val quantity: String = wording.quantity

    /** Names and values, most important first. */
    val facts: List<Pair<String, String>> = buildList {
        add("log" to "${map.log.file.fileName} (${map.log.format})")
        add("readings" to "${map.pass.readings} of $quantity")
        map.correction?.let {
            add(
                CORRECTED to
                    "${it.sensor.name} (${it.words}); maps and figures show the water, and intervals are those of a sensor known exactly",
            )
            if (it.untold > 0) {
                add(
                    "last readings" to
                        "${it.untold} left out: their dead time ends after the log, which says nothing of their water",
                )
            }
        }
        map.pass.skipped.forEach { (reason, count) -> add(reason to "$count skipped") }
        val outside = map.maps.values.maxOfOrNull { it.outside } ?: 0
        if (outside > 0) add("readings outside the grid" to "$outside in no cell")
        add("duration" to duration(statistics.duration))
        add("time between readings" to "${spread(statistics.steps)} s")
        add("gaps" to gaps())
        add("repeated fixes" to "${percent(statistics.repeatedFixes)} of readings")
        add("repeated values" to "${percent(statistics.repeatedValues)} of readings")
        val speeds = statistics.speeds
        add("speed" to if (speeds.count == 0) "log too short to tell" else "${spread(speeds)} ${wording.speed}")
        add("way" to "${digits(statistics.distance)} ${wording.length}")
        add("values" to values())
        add("grid" to grid())
        add("cells visited" to "${map.passes.visitedCells} of ${map.grid.size}")
        add("cells entered more than once" to "${map.passes.revisitedCells}")
        add("range taken for the water" to range())
        map.bounded?.let { add("epsilon" to epsilon(it.epsilon)) }
        map.maps[FilterKind.BOUNDED]?.let { add("bounded filter" to bounds(BoundCounts.of(it))) }
        map.interval?.let { add("interval filter" to it.sentence(wording::value)) }
        map.learned?.let { addAll(SensorWording(it.sensor()).facts) }
        addAll(agreement())
    }

    /** What may spoil the map, one sentence each. */
    val warnings: List<String> = MapWarnings(map).list()

    /** The facts for the terminal, a line each. */
    fun text(): String {
        val width = facts.maxOf { it.first.length }
        return facts.joinToString("\n") { (name, value) -> "  ${name.padEnd(width)}  $value" }
    }

    private fun spread(quantiles: Quantiles) = "${digits(quantiles.median)} " +
        "(5 to 95 %: ${digits(quantiles[LOW])} to ${digits(quantiles[1 - LOW])}; most ${digits(quantiles[1.0])})"

    private fun gaps() = if (map.gaps.count == 0L) {
        "none longer than ${digits(statistics.gapLimit)} s"
    } else {
        "${map.gaps.count} longer than ${digits(statistics.gapLimit)} s, " +
            "the longest ${duration(statistics.longestStep)}"
    }

    private fun values() = buildString {
        append("${digits(statistics.lowest)} to ${digits(statistics.highest)}, median ")
        append(wording.value(statistics.values.median))
        if (!statistics.resolution.isNaN()) append(", in steps of ${digits(statistics.resolution)}")
    }

    private fun grid() = map.grid.run {
        val size = if (cellWidth == cellHeight) digits(cellWidth) else "${digits(cellWidth)} x ${digits(cellHeight)}"
        val turned = if (rotation == 0.0) "" else ", turned by ${digits(Math.toDegrees(rotation))} degrees"
        "$columns x $rows cells of $size ${wording.length}$turned"
    }

    private fun range(): String {
        val outside = if (map.outsideRange == 0L) "" else "; ${map.outsideRange} readings lie outside"
        val widened = if (map.isRangeWidened) ", beyond the readings for the lag that was learned" else ""
        return "${digits(map.prior.lower)} to ${wording.value(map.prior.upper)}$widened$outside"
    }

    private fun epsilon(value: Double): String {
        val rounded = if (value == 0.0) "0" else digits(value)
        val calibration = map.calibration ?: return "$rounded$perSecond"
        val stretch = calibration.stretch
        val where =
            "${calibration.slopes} slopes within ${digits(stretch.from)} to ${digits(stretch.to)} s after the " +
                "first reading"
        return if (calibration.found < value) {
            "$rounded$perSecond, the slope of one step of the resolution; $where gave ${digits(calibration.found)} only"
        } else {
            "$rounded$perSecond, from $where"
        }
    }

    private val perSecond get() = "${wording.after} per s"

    /** What is known of the cells by the bounded filter. */
    internal fun bounds(counts: BoundCounts): String =
        "of ${counts.visited} visited cells ${counts.both} have both bounds, in ${counts.crossed} they crossed, " +
            "${counts.oneSided} have one, ${counts.none} none; ${counts.conflicts} conflicts"

    private fun agreement(): List<Pair<String, String>> = buildList {
        val mismatch = map.mismatch
        if (mismatch == null) {
            add(
                "opposite legs" to
                    "${counted(map.legs.legs.size, "straight leg")}: too few with opposite neighbours to compare",
            )
        } else {
            add("opposite legs" to "${mismatch.scores.size} of ${map.legs.legs.size} legs compared")
            add("opposite legs disagree by" to wording.estimate(mismatch.opposite))
            mismatch.same?.let { add("same-direction legs, twice as far" to wording.estimate(it)) }
            mismatch.excess?.let { add("opposite minus same, leg by leg" to wording.estimate(it)) }
            mismatch.otherWater?.let {
                val apart = "${digits(it.distance, 3)} ${wording.length} beside those the other way"
                add("legs one way" to "$apart, over which the water differs by ${wording.value(it.difference)}")
            }
            add("lag" to mismatch.verdict.label)
            add(BEST_SHIFT to ShiftWording.best(mismatch.shift))
            add("what the shift says" to shift(mismatch))
        }
        val opposite = map.passes.opposite
        val same = map.passes.same
        if (opposite.pairs > 0) {
            add("opposite passes of a cell" to "${wording.value(opposite.meanDifference)} (${opposite.pairs})")
        }
        if (same.pairs > 0) {
            add("same-way passes of a cell" to "${wording.value(same.meanDifference)} (${same.pairs})")
        }
    }

    /** What the best shift of [mismatch] says, in words. */
    internal fun shift(mismatch: LegMismatch): String {
        val shift = mismatch.shift
        return when {
            shift.legs < LagShift.FEWEST_LEGS ->
                "none can be told from ${shift.legs} legs; ${LagShift.FEWEST_LEGS} are needed"
            !shift.isClear -> "none can be told from this log; up to ${digits(shift.limit, 3)} s were tried either way"
            else ->
                "opposite legs agree best, to ${wording.value(shift.mismatch)}, with readings taken " +
                    ShiftWording.moved(shift.seconds) + reserve(mismatch)
        }
    }

    private fun reserve(mismatch: LegMismatch): String {
        if (!mismatch.hasReserve) return ""
        val excess = mismatch.excess
        val reason = when {
            excess == null || mismatch.verdict == LegVerdict.TOO_FEW_LEGS ->
                "too few legs have same-direction neighbours to hold it against"
            mismatch.verdict == LegVerdict.ASIDE -> "legs one way lie to one side of those the other way"
            excess.mean <= 0 -> "opposite legs disagree no more than same-direction ones"
            else -> "opposite legs disagree more than same-direction ones by less than two standard errors"
        }
        return "; with reserve: $reason, so that the shift may fit the water's own change instead of a lag"
    }

    internal companion object {
        /** Name of the fact that has the best shift as a number. */
        const val BEST_SHIFT = "best shift"

        /** Name of the fact that says which sensor was undone. */
        const val CORRECTED = "corrected for"
        private const val LOW = 0.05
    }
}
