package stillwater.survey

import stillwater.report.HtmlReport
import stillwater.report.Program
import stillwater.report.Provenance
import stillwater.report.SignificantDigits
import stillwater.report.Table
import stillwater.report.counted
import stillwater.run.FilterKind
import stillwater.survey.Wording.Companion.digits

/**
 * The page about a [SurveyMap].
 *
 * @param map what it is about. @param summary the same in words. @param figures its figures. @param command as typed.
 */
internal class MapReport(
    private val map: SurveyMap,
    private val summary: MapSummary,
    private val figures: List<MapFigure>,
    command: String,
) {
    private val wording = Wording(map)
    private val page = HtmlReport(
        title = "Map of ${wording.quantity}",
        subtitle = "${map.log.file.fileName}, ${map.log.format}",
        provenance = Provenance(
            Program.VERSION,
            command,
            // Nothing else is random.
            seed = LegComparison.DEFAULT_SEED.takeIf { map.mismatch != null },
            seedName = "Bootstrap seed",
        ),
    )

    /** The page's text. */
    fun render(): String {
        page.summary("Readings", "${map.pass.readings}")
        summary.facts.filter { it.first in HEADLINES }.forEach { (name, value) -> page.summary(name, value) }
        summary.warnings.forEach(page::warning)
        for (figure in figures.filter { it.name !in LATER }) {
            page.section(figure.figure.title) { figure(figure.figure, figure.caption) }
        }
        page.section("Do opposite passes agree?") { legs() }
        page.section("The log") {
            keyValues(summary.facts)
            figures.firstOrNull { it.name == "speed" }?.let { figure(it.figure, it.caption) }
        }
        page.section("How it was made") { how().forEach(::paragraph) }
        return page.render()
    }

    private fun stillwater.report.ReportSection.legs() {
        val mismatch = map.mismatch
        if (mismatch == null) {
            paragraph(
                "This log has ${counted(
                    map.legs.legs.size,
                    "straight leg",
                )}, too few with neighbours in the opposite direction " +
                    "to compare: the lag cannot be seen in it this way.",
            )
            return
        }
        paragraph(
            "A slow sensor drags old water along, so that passes in opposite directions disagree. " +
                "${mismatch.scores.size} of ${map.legs.legs.size} legs have a neighbour in the opposite direction on " +
                "either side; they differ from the mean of the two by ${wording.estimate(mismatch.opposite)} " +
                "(mean absolute difference in bins of ${SignificantDigits(
                    2,
                ).format(mismatch.binWidth)} ${wording.length}, and its " +
                "standard error). The water's own change from leg to leg is in this number.",
        )
        val same = mismatch.same
        val paired = mismatch.paired
        val excess = mismatch.excess
        if (same != null && paired != null && excess != null) {
            paragraph(
                "To hold against: legs in the same direction, which share the lag but lie twice as far apart, differ " +
                    "by ${wording.estimate(same)}; the same legs differ from their opposite neighbours by " +
                    "${wording.estimate(paired)}. Opposite minus same, leg by leg: ${wording.estimate(excess)} " +
                    "over ${mismatch.pairedLegs} legs. Above 0 by more than two standard errors it speaks for a lag.",
            )
        }
        mismatch.otherWater?.let {
            paragraph(
                "Legs one way lie ${digits(it.distance, 3)} ${wording.length} to one side of those the other way. " +
                    "Along the legs the water differs by ${wording.value(it.difference)} over that distance, or " +
                    "over half a leg where it is more, and may by up to twice as much across them: that is no lag.",
            )
        }
        paragraph("Verdict: ${mismatch.verdict.label}.")
        paragraph(
            "Shift in time: ${summary.shift(mismatch)}. This is a diagnostic, not a model: a dead time, " +
                "a time constant and a late clock or receiver all look alike here.",
        )
        figures.firstOrNull { it.name == "leg-mismatch" }?.let { figure(it.figure, it.caption) }
        details("Leg by leg") {
            table(
                Table.of(mismatch.scores) {
                    count("Leg") { it.number.toLong() }
                    text("Direction") { score -> direction(map.legs.legs[score.number - 1]) }
                    number("Length (${wording.length})") { score -> map.legs.legs[score.number - 1].length }
                    number("Opposite neighbours differ by") { it.opposite }
                    number("Same-direction ones by") { it.same }
                },
            )
        }
    }

    private fun how(): List<String> {
        val positions = when {
            map.log.oneDimensional -> "Positions are those of the column ${map.log.xName}, in its own units."
            map.log.frame == null -> "Positions are metres east and north, as the log has them."
            else ->
                "Positions are metres east and north of the first fix on the plane tangent to the WGS-84 ellipsoid " +
                    "there."
        }
        val corrected = map.correction?.let {
            "The readings were corrected for the sensor given, ${it.sensor.name} (${it.words}), as `stillwater " +
                "correct` does; a cell's interval is the mean of its readings' 95 % intervals, and holds if that " +
                "sensor is the right one."
        }
        val wish = map.settings.grid
        val isChosen = wish.cell == null && wish.columns == null
        val taken = listOfNotNull(GRID.takeIf { isChosen }, RANGE.takeIf { !map.rangeGiven }, corrected)
        val epsilon = listOfNotNull(EPSILON.takeIf { map.bounded != null })
        return listOf(positions) + taken + map.maps.keys.map(::how) + epsilon
    }

    private fun how(kind: FilterKind): String = when (kind) {
        FilterKind.AVERAGING -> "The averaging filter gives the mean of a cell's readings."
        FilterKind.EXPONENTIAL -> "The exponential filter gives the exponential average of a cell's readings."
        FilterKind.BOUNDED ->
            "The bounded filter takes a rising sensor's reading as a lower bound and a falling one's as an upper " +
                "bound, if the slope over a window of medians exceeds epsilon; its value is the midpoint. Its bounds " +
                "hold for a first-order sensor without noise in water that does not change within a cell; conflicts " +
                "show where they do not."
        FilterKind.INTERVAL ->
            "The interval filter's bounds hold for every first-order sensor no slower, and readings no farther off, " +
                "than was said, in water that does not change within a cell; its value is the midpoint."
        FilterKind.SELF_CALIBRATING -> "The self-calibrating filter $learns"
        FilterKind.BOUNDED_EXTENDED ->
            "The bounded-extended filter learns from the readings how noisy they are and how far the water is from " +
                "them by their slope; its bounds are 95 % intervals, cut to the range taken for the water, and take " +
                "the water of a cell for the same all over."
        FilterKind.BAYESIAN ->
            "The bayesian filter is a Gaussian process over the cells on top of one that $learns Cells around one " +
                "tell of it, too."
    }

    private val learns: String
        get() = "learns the sensor's response from how readings change where the boat enters a cell, and gives the " +
            "water of each cell with a 95 % interval. It takes a cell's water for the same all over and at all " +
            "times, and says so where that is not borne out. The time over a border counts for neither cell, nor do " +
            "readings nearer to one than places are known " +
            "(${digits(map.statistics.placeDeviation, 2)} ${wording.length})."

    private fun direction(leg: Leg): String {
        if (map.log.oneDimensional) return if (leg.forward) "rising" else "falling"
        val heading = Math.toDegrees(map.legs.axis) + if (leg.forward) 0.0 else HALF_TURN
        val compass = (QUARTER_TURN - heading).mod(2 * HALF_TURN)
        return "${Math.round(compass) % (2 * HALF_TURN).toInt()}°"
    }

    private companion object {
        const val HALF_TURN = 180.0
        const val QUARTER_TURN = 90.0
        val LATER = setOf("leg-mismatch", "speed")
        val HEADLINES =
            setOf(
                MapSummary.CORRECTED,
                "duration",
                "values",
                "grid",
                "opposite legs disagree by",
                "lag",
                MapSummary.BEST_SHIFT,
            )
        const val GRID =
            "The side of a cell is 1, 2 or 5 times a power of ten, a little below the larger of the way the boat " +
                "makes in ten readings and the mean distance between tracks (area by length of track), with 10 " +
                "to 100 cells along the longer side."
        const val RANGE =
            "The range taken for the water is that of the readings and a tenth of it more either way, because a slow " +
                "sensor falls short of the water's extremes; where a lag was learned from all readings, the range of " +
                "the cells that it shows well and a tenth more, if that is wider."
        const val EPSILON =
            "Epsilon is the 99 % quantile of how far slopes are from their median over the stretch of the log where " +
                "that is smallest, unless a stretch or a number was given; but not below the slope that one step of " +
                "the sensor's resolution makes, unless a number was given."
    }
}
