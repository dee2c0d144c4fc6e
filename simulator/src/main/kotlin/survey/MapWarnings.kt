package stillwater.survey

import stillwater.run.FilterKind
import stillwater.survey.Wording.Companion.digits
import stillwater.survey.Wording.Companion.duration
import stillwater.survey.Wording.Companion.percent

/**
 * What may spoil a [SurveyMap], one sentence each.
 *
 * @param map the map.
 */
internal class MapWarnings(private val map: SurveyMap) {
    private val statistics = map.statistics
    private val wording = Wording(map)

    /** The sentences, most important first. */
    fun list(): List<String> = map.pass.warnings + map.correction?.cautions.orEmpty() +
        listOfNotNull(untold(), gap(), outliers(), outsideRange(), skipped(), standing()) +
        (if (map.correction == null) ofFilters() else listOfNotNull(twice())) +
        listOfNotNull("the log has no latitudes, so no cells.geojson is written".takeIf { map.log.frame == null })

    private fun unevenCells(): String? {
        val belief = map.learned?.sensor() ?: return null
        val why = when {
            !belief.areCellsEven -> "nothing shows that the water changes at the cells' borders and not within cells"
            !belief.isWaterSteady ->
                "the water of cells changed between one visit and another, or fixes are off or late"
            !belief.isExplained -> "no sensor that is known explains the readings in these cells"
            else -> return null
        }
        val filter = if (FilterKind.SELF_CALIBRATING in map.maps) "self-calibrating" else "bayesian"
        return "$why, so $filter cannot learn the sensor: its bounds are wide, and its values may be as late as the " +
            "readings; `stillwater correct` needs no cells and writes a sensor.json, which `map --sensor` undoes"
    }

    private fun ofFilters(): List<String> =
        listOfNotNull(unevenCells(), slow(), unevenBounds()) + epsilon() + bounds() +
            listOfNotNull(map.interval?.warning(wording::value))

    /** [filters] as the subject of a sentence, with what goes with one of them or with several. */
    private class Subject(filters: List<FilterKind>) {
        private val areSeveral = filters.size > 1
        private val names = filters.joinToString(" and ") { it.label }
        val their = if (areSeveral) "their" else "its"

        fun does(verb: String) = if (areSeveral) "$names $verb" else "$names ${verb}s"
    }

    /** The filters that ran of which [which] is so; null for none. */
    private fun subject(which: (FilterKind) -> Boolean): Subject? {
        val filters = map.maps.keys.filter(which)
        return if (filters.isEmpty()) null else Subject(filters)
    }

    /** Filters that undo a lag, of readings of which it is undone already. */
    private fun twice(): String? {
        val filters = subject { it.undoesLag } ?: return null
        return "${filters.does("reckon")} with a lag that --sensor has undone already: " +
            "${filters.their} bounds and values are not the water's; averaging is for corrected readings"
    }

    /** A lag so long that readings, and the range that is taken by these, fall far short of the water's. */
    private fun slow(): String? {
        val learned = map.learned?.takeIf { it.isExplained && !map.rangeGiven && !map.isRangeLearned } ?: return null
        val field = learned.map
        val stay = statistics.duration / maxOf(field.visitedCells().sumOf { field.visits(it) }, 1)
        if (learned.timeConstant < stay) return null
        return "the time constant found (${digits(learned.timeConstant)} s) is longer than a stay in a cell " +
            "(${digits(stay)} s), so that readings fall far short of the water's extremes, and so may the range to " +
            "which values and bounds are cut: give --range, or a larger --cell"
    }

    /** Bounds that take the water of a cell for the same all over, where nothing shows that it is. */
    private fun unevenBounds(): String? {
        if (map.areCellsEven) return null
        val filters = subject { it.needsEvenCells } ?: return null
        return "nothing shows that the water changes at the cells' borders and not within cells, which " +
            "${filters.does("take")} for granted: ${filters.their} bounds may miss the water of a cell; " +
            "`stillwater correct` needs no cells"
    }

    private fun untold(): String? {
        val untold = map.correction?.untold?.takeIf { it > MANY_UNTOLD * map.pass.readings } ?: return null
        return "$untold of ${map.pass.readings} readings are left out, for their dead time ends after the log: " +
            "is the sensor given this log's?"
    }

    private fun gap(): String? {
        val longest = map.gaps.longest?.takeIf { it.seconds >= LONG_GAP } ?: return null
        val more = when (val others = map.gaps.count - 1) {
            0L -> ""
            1L -> "; 1 more gap is shorter"
            else -> "; $others more gaps are shorter"
        }
        return "no reading for ${duration(longest.seconds)} from ${digits(longest.start)} s after the first on, and " +
            "the next lies ${digits(longest.jump)} ${wording.length} away$more: nothing is known about the way between"
    }

    private fun outliers(): String? {
        val whole = statistics.highest - statistics.lowest
        fun usual(rare: Double) = statistics.values[1 - rare] - statistics.values[rare]
        // A code such as 9999 may be in more rows than one in a hundred; water is that far off in few.
        val (rare, _) = OUTLYING.firstOrNull { (rare, times) -> usual(rare) > 0 && whole > times * usual(rare) }
            ?: return null
        val isBounded = FilterKind.BOUNDED in map.maps
        val remedies = listOfNotNull(
            "are in the means of their cells".takeIf { FilterKind.AVERAGING in map.maps },
            "set the range of the bounded filter; give --range".takeIf { isBounded && !map.rangeGiven },
        )
        val remedy = if (remedies.isEmpty()) "" else remedies.joinToString(" and ", ": those beyond ")
        return "values reach from ${digits(statistics.lowest)} to ${digits(statistics.highest)} but " +
            "${Math.round(PERCENT * (1 - 2 * rare))} % lie within " +
            "${digits(statistics.values[rare])} to ${digits(statistics.values[1 - rare])}$remedy"
    }

    private fun outsideRange(): String? {
        if (!map.rangeGiven || map.outsideRange == 0L) return null
        return "${map.outsideRange} of ${map.pass.readings} readings " +
            "(${percent(map.outsideRange.toDouble() / map.pass.readings)}) lie outside --range " +
            "${map.prior.lower}:${map.prior.upper}: as bounds they contradict it; give a wider range"
    }

    private fun skipped(): String? {
        // Before the first fix every log has some; that is no fault of its.
        val skipped = map.pass.skipped.filterKeys { it !in HARMLESS }.values.sum()
        if (skipped <= MANY_SKIPPED * map.pass.readings) return null
        val were = if (skipped == 1L) "reading or line was" else "readings or lines were"
        return "$skipped $were skipped, against ${map.pass.readings} readings used"
    }

    private fun epsilon(): List<String> = buildList {
        val epsilon = map.bounded?.epsilon ?: return@buildList
        val calibration = map.calibration
        if (calibration != null && calibration.slopes < FEW_SLOPES) {
            add("epsilon rests on ${calibration.slopes} slopes only; give --epsilon or a longer log")
        }
        if (map.stepSlope > epsilon) {
            add(
                "epsilon (${digits(epsilon)} per s) is below the slope that one step of the sensor's resolution " +
                    "makes, so that every step counts as one; try --epsilon ${digits(map.stepSlope)}",
            )
        } else if (epsilon == 0.0) {
            val reason = when {
                calibration != null -> "the sensor did not change on the stretch it was found on"
                map.epsilonGiven -> "as asked for"
                else -> "there are too few readings in a row to find one"
            }
            add("epsilon is 0: $reason, so every slope counts as one")
        }
    }

    private fun standing(): String? {
        val isStanding = statistics.speeds.count > 0 && statistics.speeds.median < SLOW
        if (!isStanding) return null
        val isFixed = statistics.east <= statistics.west && statistics.north <= statistics.south
        if (isFixed) return "the boat never moved: the map is of one place"
        return "the boat hardly moved (median speed ${digits(statistics.speeds.median)} ${wording.speed}): " +
            "the map shows little"
    }

    private fun bounds(): List<String> = buildList {
        val counts = map.maps[FilterKind.BOUNDED]?.let { BoundCounts.of(it) } ?: return@buildList
        if (counts.crossed > 0) {
            add(
                "the bounds crossed (lower above upper) in ${counts.crossed} of ${counts.visited} visited cells: the " +
                    "readings there contradict each other, by noise taken for a slope or by water that differs " +
                    "within the cell or in time, and the truth need not lie between; try a larger --epsilon, a " +
                    "smaller --cell, or --crossing soft",
            )
        }
        val bothSides = counts.both + counts.crossed
        if (bothSides < FEW_BOUNDED * counts.visited) {
            val cells = "of ${counts.visited} visited cells"
            val which = if (bothSides == 0) "none $cells" else "$bothSides $cells only"
            add(
                "the bounded filter has bounds from both sides in $which, because ${few(counts)}; elsewhere it has " +
                    "none, or one, and then its value leans on the range taken for the water",
            )
        }
    }

    /** Why few cells have both bounds. */
    private fun few(counts: BoundCounts): String {
        val settings = checkNotNull(map.bounded)
        val field = map.maps.getValue(FilterKind.BOUNDED)
        val needed = settings.medianWindow + settings.slopeWindow - 1
        val short = field.visitedCells().count { field.readings(it) < needed.toLong() * field.visits(it) }
        return when {
            2 * short > counts.visited ->
                "the boat takes fewer than the $needed readings there that a slope needs, on average of its passes " +
                    "(a larger --cell, or smaller windows)"
            counts.none > counts.oneSided && settings.epsilon == 0.0 -> "readings hardly change within cells"
            counts.none > counts.oneSided -> "few slopes in a cell exceed epsilon"
            else -> "few were crossed both ways"
        }
    }

    private companion object {
        val HARMLESS =
            setOf("poses before the first fix", "positions without a fix (0, 0)", "blank lines", "lines of units")
        const val LONG_GAP = 60.0
        const val PERCENT = 100

        /** Shares of readings, either way, and how many times as far as the others all together lie these are far off. */
        val OUTLYING = listOf(0.01 to 3, 0.05 to 10)
        const val MANY_UNTOLD = 0.1
        const val MANY_SKIPPED = 0.01
        const val FEW_SLOPES = 20
        const val FEW_BOUNDED = 0.5
        const val SLOW = 0.05
    }
}
