package stillwater.diagnose.reference

import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceNoise
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.UnknownTruth
import stillwater.diagnose.track.SmoothCourse
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * A log with a reference of less noise, where its own noise shows in the readings. A model that takes noise for truth is wrong in
 * its response, whatever the sensor's.
 *
 * @param used rows that are fitted. @param longest longest correlation time of noise, s.
 */
internal class QuieterReference(
    private val series: MeasuredSeries,
    private val unknown: UnknownTruth,
    private val models: BaseModels,
    private val used: BooleanArray,
    private val longest: Double,
    private val loops: Loops,
) {
    private var levels: SampleLevels? = null
    private val reference = requireNotNull(series.reference) { "there is a reference to take noise off" }

    /** The log with the course that the base is likeliest with; null where the reference's noise does not show. */
    fun likeliest(): MeasuredSeries? {
        // Water that changes faster than a sparse reference shows looks like noise.
        if (series.size < FEWEST || series.isSparse) return null
        val noise = ReferenceNoise(series.times, reference, unknown.isBroken)
        val shown = noise.spread * abs(models.rough.numbers[ResponseModel.GAIN])
        if (!(shown > NOISY * Spikes.spread(series.shown(models.rough.whitened)))) return null
        // How much of its noise is taken off is asked of the readings: what is left would make a response that smooths
        // it (the truth held, and a lag more that undoes the lead) look likelier than the right one. Nothing is to go
        // that is more than the noise.
        val courses = SmoothCourse(reference, unknown.isBroken)
        val most = noise.spread * (1 + CLEARLY / sqrt(2.0 * series.size))
        fun isNoise(course: DoubleArray) =
            squares(DoubleArray(series.size) { reference[it] - course[it] }) <= most * most * series.size
        val smooth = SmoothCourse.STIFFNESSES.map(courses::of).filter(::isNoise)
        val quiet = smooth + noise.smoothed()
        val (best, worth) = quiet.map(series::withQuieter).map { it to explained(it) }.maxBy { it.second }
        val own = SampleLevels(series, unknown.isBroken, noise.spread, longest, loops)
        if (!own.isFew || !isNoise(own.means)) return best
        val (heights, told) = own.told(fit)
        if (told < worth) return best
        levels = own
        return series.withQuieter(heights)
    }

    /**
     * The same log with the course that is likeliest with the sensor of [fit], where that was found as heights of samples: what no
     * base can show, as an end of the range, moves these. Else null.
     */
    fun with(fit: ModelFit): MeasuredSeries? = levels?.let { series.withQuieter(it.told(fit).first) }

    /** What the readings follow. Of sharp steps it must be known which rows these shake, and how they go on between rows. */
    private val fit by lazy { if (unknown.isSharp) models.settled(null) else models.rough }

    /** Twice the log-likelihood of the base for [quiet], this log with another reference. */
    private fun explained(quiet: MeasuredSeries): Double {
        val (steps, scales) =
            if (unknown.isSharp) fit.model.steps to fit.model.scales.of(quiet) else Steps.EVEN to Scales(quiet, unknown)
        val model = ResponseModel(quiet, fit.model.terms, steps, scales)
        return Fitting.fit(model, fit.numbers, fit.free, used, longest, guess = fit.noise).score
    }

    private companion object {
        const val FEWEST = 30

        /** Noise of the reference, in that of the readings, above which it is taken off. */
        const val NOISY = 0.2

        /** Standard errors of the reference's noise by which what is taken off may be larger. */
        const val CLEARLY = 3.0
    }
}
