package stillwater.survey

import stillwater.field.FieldMap
import stillwater.report.SignificantDigits
import stillwater.run.FilterKind
import java.util.Locale

/**
 * What a [SurveyMap] comes to in words and rounded numbers, for the terminal and the report.
 *
 * @param map the map.
 */
class MapSummary(private val map: SurveyMap) {
    private val statistics = map.statistics

    /** Names and values, most important first. */
    val facts: List<Pair<String, String>> = buildList {
        add("log" to "${map.log.file.fileName} (${map.log.format})")
        add("readings" to "${map.pass.readings} of ${map.log.quantity}")
        map.pass.skipped.forEach { (reason, count) -> add(reason to "$count skipped") }
        val outside = map.maps.values.maxOfOrNull { it.outside } ?: 0
        if (outside > 0) add("readings outside the grid" to "$outside in no cell")
        add("duration" to duration(statistics.duration))
        add("time between readings" to "${spread(statistics.steps)} s")
        add("gaps" to gaps())
        add("repeated fixes" to percent(statistics.repeatedFixes))
        add("repeated values" to percent(statistics.repeatedValues))
        add(
            "speed" to if (statistics.speeds.count ==
                0
            ) {
                "log too short to tell"
            } else {
                "${spread(statistics.speeds)} m/s"
            },
        )
        add("way" to "${digits(statistics.distance)} m")
        add("values" to values())
        add("grid" to grid())
        add("cells visited" to "${map.passes.visitedCells} of ${map.grid.size}")
        add("cells entered more than once" to "${map.passes.revisitedCells}")
        add("range taken for the water" to "${digits(map.prior.lower)} to ${digits(map.prior.upper)}")
        map.bounded?.let { add("epsilon" to epsilon(it.epsilon)) }
        map.maps[FilterKind.BOUNDED]?.let { add("bounded filter" to bounds(it)) }
        addAll(agreement())
    }

    /** What may spoil the map, one sentence each. */
    val warnings: List<String> = buildList {
        if (statistics.jumps > 0) {
            add("${statistics.jumps} jumps in the positions are faster than 20 m/s: check the receiver's fixes")
        }
        outliers()?.let(::add)
        // Before the first fix every log has some; that is no fault of its.
        val skipped = map.pass.skipped.filterKeys { it !in HARMLESS }.values.sum()
        if (skipped > MANY_SKIPPED * map.pass.readings) {
            add("$skipped readings or lines were skipped, against ${map.pass.readings} readings used")
        }
        val calibration = map.calibration
        if (map.bounded != null && map.bounded.epsilon == 0.0 && calibration == null) {
            add("epsilon is 0: there are too few readings in a row to find one, so every slope counts as one")
        } else if (calibration != null && calibration.slopes < FEW_SLOPES) {
            add("epsilon rests on ${calibration.slopes} slopes only; give --epsilon or a longer log")
        }
        if (statistics.speeds.count > 0 && statistics.speeds.median < SLOW && statistics.east > statistics.west) {
            add("the boat hardly moved (median speed ${digits(statistics.speeds.median)} m/s): the map shows little")
        }
        map.maps[FilterKind.BOUNDED]?.let { field ->
            val both = field.visitedCells().count { field.isBoundedBothWays(it) }
            if (both < FEW_BOUNDED * map.passes.visitedCells) {
                add(
                    "the bounded filter has both bounds in $both of ${map.passes.visitedCells} visited cells only, " +
                        "because few were crossed both ways; elsewhere its value leans on the range taken for the water",
                )
            }
        }
        if (map.log.frame == null) add("the log has no latitudes, so no cells.geojson is written")
    }

    /** The facts for the terminal, a line each. */
    fun text(): String {
        val width = facts.maxOf { it.first.length }
        return facts.joinToString("\n") { (name, value) -> "  ${name.padEnd(width)}  $value" }
    }

    private fun duration(seconds: Double): String {
        val rounded = "${digits(seconds)} s"
        return when {
            seconds >= 2 * HOUR -> "$rounded (${digits(seconds / HOUR)} h)"
            seconds >= 2 * MINUTE -> "$rounded (${digits(seconds / MINUTE)} min)"
            else -> rounded
        }
    }

    private fun spread(quantiles: Quantiles) = "${digits(quantiles.median)} " +
        "(5 to 95 %: ${digits(quantiles[LOW])} to ${digits(quantiles[1 - LOW])}; most ${digits(quantiles[1.0])})"

    private fun gaps() = if (map.gaps == 0L) {
        "none longer than ${digits(statistics.gapLimit)} s"
    } else {
        "${map.gaps} longer than ${digits(statistics.gapLimit)} s, the longest ${duration(statistics.longestStep)}"
    }

    private fun values() = buildString {
        append(
            "${digits(statistics.lowest)} to ${digits(statistics.highest)}, median ${digits(statistics.values.median)}",
        )
        if (!statistics.resolution.isNaN()) append(", in steps of ${digits(statistics.resolution)}")
    }

    private fun grid() = map.grid.run {
        val size = if (cellWidth == cellHeight) digits(cellWidth) else "${digits(cellWidth)} x ${digits(cellHeight)}"
        val turned = if (rotation == 0.0) "" else ", turned by ${digits(Math.toDegrees(rotation))} degrees"
        "$columns x $rows cells of $size m$turned"
    }

    private fun epsilon(value: Double): String {
        val rounded = if (value == 0.0) "0" else digits(value)
        val calibration = map.calibration ?: return "$rounded per s"
        val stretch = calibration.stretch
        return "$rounded per s, from ${calibration.slopes} slopes within " +
            "${digits(stretch.from)} to ${digits(stretch.to)} s after the first reading"
    }

    private fun bounds(field: FieldMap): String {
        val visited = field.visitedCells()
        val bounded = visited.count { field.hasBound(it) }
        val both = visited.count { field.isBoundedBothWays(it) }
        val conflicts = visited.sumOf { field.conflicts(it).toLong() }
        return "a bound in $bounded of ${visited.size} visited cells, both in $both, $conflicts conflicts"
    }

    private fun agreement(): List<Pair<String, String>> = buildList {
        val mismatch = map.mismatch
        if (mismatch == null) {
            add("opposite legs" to "${map.legs.legs.size} straight legs: too few with opposite neighbours to compare")
        } else {
            add("opposite legs" to "${mismatch.scores.size} of ${map.legs.legs.size} legs compared")
            add("opposite legs disagree by" to estimate(mismatch.opposite))
            mismatch.same?.let { add("same-direction legs, twice as far" to estimate(it)) }
            add("best shift" to shift(mismatch.shift))
        }
        val opposite = map.passes.opposite
        val same = map.passes.same
        if (opposite.pairs >
            0
        ) {
            add("opposite passes of a cell" to "${digits(opposite.meanDifference)} (${opposite.pairs})")
        }
        if (same.pairs > 0) add("same-way passes of a cell" to "${digits(same.meanDifference)} (${same.pairs})")
    }

    /** The shift in words. */
    fun shift(shift: LagShift): String {
        val interval = "95 %: ${digits(shift.low, 3)} to ${digits(shift.high, 3)} s"
        val way = if (shift.seconds > 0) "earlier" else "later"
        val best = "${digits(kotlin.math.abs(shift.seconds), 3)} s $way"
        return when {
            shift.legs < LagShift.FEWEST_LEGS ->
                "none can be told from ${shift.legs} legs; ${LagShift.FEWEST_LEGS} are needed (best $best, $interval)"
            !shift.isClear ->
                "none can be told from this log (best $best, $interval, up to ${digits(shift.limit, 3)} s tried)"
            else -> "opposite legs agree best, to ${digits(shift.mismatch)}, with readings taken $best ($interval)"
        }
    }

    /** Mean and standard error. */
    fun estimate(estimate: Estimate): String = "${digits(estimate.mean)} ± ${digits(estimate.standardError, 2)}"

    private fun outliers(): String? {
        val usual = statistics.values[1 - RARE] - statistics.values[RARE]
        val whole = statistics.highest - statistics.lowest
        if (usual <= 0 || whole <= OUTLYING * usual) return null
        return "values reach from ${digits(statistics.lowest)} to ${digits(statistics.highest)} but 98 % lie within " +
            "${digits(statistics.values[RARE])} to ${digits(statistics.values[1 - RARE])}: " +
            "outliers set the range of the bounded filter; give --range"
    }

    private fun percent(share: Double) = String.format(Locale.ROOT, "%.1f %% of readings", PERCENT * share)

    private fun digits(value: Double, count: Int = 4) = SignificantDigits(count).format(value)
        .let { if ('.' in it && 'e' !in it) it.trimEnd('0').trimEnd('.') else it }

    private companion object {
        val HARMLESS = setOf("poses before the first fix", "positions without a fix (0, 0)", "blank lines")
        const val MINUTE = 60.0
        const val HOUR = 3600.0
        const val LOW = 0.05
        const val RARE = 0.01
        const val OUTLYING = 3
        const val MANY_SKIPPED = 0.01
        const val FEW_SLOPES = 20
        const val FEW_BOUNDED = 0.5
        const val SLOW = 0.05
        const val PERCENT = 100.0
    }
}

/** Whether evidence has narrowed the range of [cell] at all. */
internal fun FieldMap.hasBound(cell: Int): Boolean = lower(cell) > prior.lower || upper(cell) < prior.upper

/** Whether evidence has narrowed the range of [cell] from below and from above. */
internal fun FieldMap.isBoundedBothWays(cell: Int): Boolean = lower(cell) > prior.lower && upper(cell) < prior.upper

/** Indices of the cells the boat entered. */
internal fun FieldMap.visitedCells(): List<Int> = (0 until grid.size).filter { visits(it) > 0 }
