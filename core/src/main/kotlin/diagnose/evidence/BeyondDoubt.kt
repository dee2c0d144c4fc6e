package stillwater.diagnose.evidence

import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import kotlin.math.abs

/** Rows of [fit] that are far off whatever the truth was where it is not known. */
internal class BeyondDoubt(private val fit: ModelFit) {
    private val usual by lazy { Spikes.spread(fit.model.series.shown(fit.whitened)) }
    private val isFading = fit.numbers[ResponseModel.TIME_CONSTANT] > FADING * fit.model.series.period

    /**
     * Whether row [i] is off alone by more than what is not known of the truth may make it: that fades with the lag, over
     * the rows after it.
     */
    operator fun contains(i: Int): Boolean =
        isFading && abs(fit.residuals[i]) > FAR_OFF * usual && Spikes.isSingle(fit.residuals, i)

    private companion object {
        /** Rows, within a time constant, that show what fades. */
        const val FADING = 3.0

        /** Deviations of the noise by which a row is far off in doubt. */
        const val FAR_OFF = 20.0
    }
}
