package stillwater.correct

import stillwater.estimate.CandidateStanding
import stillwater.plot.Bar
import stillwater.plot.Bars
import stillwater.plot.Figure
import stillwater.plot.LinePlot
import stillwater.plot.Series
import stillwater.plot.drawConcurrently
import stillwater.survey.LegMismatch

/** A figure with its file's name and what stands under it. */
internal class CorrectFigure(val name: String, val figure: Figure, val caption: String)

/** Draws a [CorrectedLog]. */
internal class CorrectFigures(private val result: CorrectedLog, private val summary: CorrectSummary) {
    /** All that there is something to draw for, with their PNGs, on up to all cores. */
    fun draw(): List<CorrectFigure> {
        val before = result.before
        val after = result.after
        val drawings: List<() -> CorrectFigure> = buildList {
            add { track() }
            if (before != null && after != null) add { legs(before, after) }
            result.choice?.let { add { evidence(it.standings) } }
        }
        return drawConcurrently(drawings) { it.figure }
    }

    private fun track(): CorrectFigure {
        val shown = window()
        fun of(values: DoubleArray) = values.copyOfRange(shown.first, shown.last + 1)
        val start = result.series.times[0]
        val seconds = of(result.series.times).also { for (i in it.indices) it[i] -= start }
        val figure = LinePlot(
            "Measured and corrected",
            stretch(shown),
            listOf(
                Series("measured", seconds, of(result.series.values)),
                Series("corrected", seconds, of(result.track.values), of(result.track.lower), of(result.track.upper)),
            ),
            "Time since the first reading (s)",
            summary.quantity,
        ).draw()
        return CorrectFigure("corrected", figure, "The band is the 95 % interval of the water's value at each reading.")
    }

    private fun stretch(shown: IntRange): String {
        val count = shown.last - shown.first + 1
        return if (count ==
            result.series.size
        ) {
            "all $count readings"
        } else {
            "the $count readings in a row that differ most"
        }
    }

    /** The stretch of at most [SHOWN] readings with the largest differences between measured and corrected. */
    private fun window(): IntRange {
        val n = result.series.size
        if (n <= SHOWN) return 0 until n
        var sum = 0.0
        var best = 0.0
        var end = SHOWN - 1
        for (i in 0 until n) {
            sum += difference(i)
            if (i >= SHOWN) sum -= difference(i - SHOWN)
            if (i >= SHOWN - 1 && sum > best) {
                best = sum
                end = i
            }
        }
        return end - SHOWN + 1..end
    }

    private fun difference(i: Int) = (result.track.values[i] - result.series.values[i]).let { it * it }

    private fun legs(before: LegMismatch, after: LegMismatch): CorrectFigure {
        fun bar(name: String, mean: Double, error: Double): Bar {
            val reach = if (error.isNaN()) 0.0 else 2 * error
            return Bar(name, mean, maxOf(0.0, mean - reach), mean + reach)
        }
        val figure = Bars(
            "Disagreement of opposite legs",
            "each leg against the mean of its two neighbours",
            listOfNotNull(
                bar("as measured", before.opposite.mean, before.opposite.standardError),
                result.smoothed?.let { bar("smoothed only", it.opposite.mean, it.opposite.standardError) },
                bar("corrected", after.opposite.mean, after.opposite.standardError),
            ),
            "Mean absolute difference (${summary.quantity})",
        ).draw()
        return CorrectFigure(
            "legs",
            figure,
            "Whiskers are two standard errors. The water's own change from leg to leg is in all. Smoothed only: " +
                "the readings as the correction smooths them, with no lag undone.",
        )
    }

    private fun evidence(standings: List<CandidateStanding>): CorrectFigure {
        val figure = Bars(
            "What the log says about the sensor's response",
            "log score on held-out runs of the track, behind the best",
            standings.sortedBy { it.behind }.map {
                // Names with all their numbers run out of the figure; the table has them.
                val name = it.candidate.kind.label + if (it.isOpen) ", open" else ""
                Bar(name, it.behind, maxOf(0.0, it.behind - 2 * it.error), it.behind + 2 * it.error)
            },
            "Behind the best (natural logarithm of the density)",
        ).draw()
        return CorrectFigure(
            "evidence",
            figure,
            "Whiskers are two standard errors from the scatter between groups of neighbouring runs. What is marked " +
                "open is not ruled out. An asymmetric lag and two paths give way to something simpler that they hold " +
                "and that explains about as much. The table under Candidates has the parameters.",
        )
    }

    companion object {
        /** Names of all figures there may be. */
        val NAMES = listOf("corrected", "legs", "evidence")
        private const val SHOWN = 600
    }
}
