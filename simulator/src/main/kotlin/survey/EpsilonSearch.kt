package stillwater.survey

import stillwater.estimate.EpsilonCalibration
import stillwater.io.LogProblem
import stillwater.io.SurveyLog
import stillwater.run.FilterKind

/** Finds epsilon on the first reading of a log where [settings] ask for it. */
internal class EpsilonSearch(private val settings: MapSettings) {
    private val isNeeded = settings.epsilon == null && FilterKind.BOUNDED in settings.filters
    private val quietest = QuietestStretch(settings.boundedFilter.medianWindow, settings.boundedFilter.slopeWindow)
    private val chosen = EpsilonCalibration(settings.boundedFilter.medianWindow, settings.boundedFilter.slopeWindow)
    private var start = Double.NaN

    fun add(seconds: Double, value: Double) {
        if (!isNeeded) return
        if (start.isNaN()) start = seconds
        val stretch = settings.calibrate
        if (stretch == null) {
            quietest.add(seconds, value)
        } else if (seconds - start in stretch.from..stretch.to) {
            chosen.add(seconds, value)
        }
    }

    fun calibration(log: SurveyLog): Calibration? {
        val stretch = settings.calibrate
        if (!isNeeded || stretch == null) return if (isNeeded) quietest.calibration() else null
        if (chosen.slopes == 0) {
            val fewest = settings.boundedFilter.medianWindow + settings.boundedFilter.slopeWindow - 1
            val expected = "--calibrate with at least $fewest readings"
            throw LogProblem(log.file, null, null, expected, "fewer within ${stretch.from}:${stretch.to} s")
        }
        return Calibration(chosen.epsilon(), stretch, chosen.slopes)
    }
}
