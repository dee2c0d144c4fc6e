package stillwater.diagnose

import stillwater.model.Interval
import stillwater.sensor.SensorSpec

/** What a diagnosis comes to. */
public sealed interface Verdict {
    /** The name in files. */
    public val label: String

    /** Sets of causes of each of which something is at work, where this track cannot tell which. */
    public val ambiguity: List<List<Cause>> get() = emptyList()

    /** [causes], one or a combination, explain the log, and nothing else of the list does. */
    public data class Named(val causes: List<Cause>) : Verdict {
        override val label: String get() = "named"
    }

    /** Something of each of [sets] is at work; this track cannot tell which. A set of one is certain. */
    public data class Ambiguous(val sets: List<List<Cause>>) : Verdict {
        override val label: String get() = "ambiguous"
        override val ambiguity: List<List<Cause>> get() = sets.filter { it.size > 1 }
    }

    /** The base model explains the log. */
    public data object Consistent : Verdict {
        override val label: String get() = "consistent"
    }

    /** Structure is left that no cause explains: [what]. What is seen for certain beside it is in [ambiguity]. */
    public data class Unexplained(
        val what: String,
        override val ambiguity: List<List<Cause>> = emptyList(),
    ) : Verdict {
        override val label: String get() = "unexplained"
    }

    /** The log could not have shown it: [why]. */
    public data class InsufficientData(val why: String) : Verdict {
        override val label: String get() = "insufficient-data"
    }
}

/**
 * A number of a fitted model.
 *
 * @property name as in [SensorSpec]'s JSON where it has a place there. @property unit its unit, empty for none.
 * @property value the estimate. @property interval where it lies at 95 %, given that the model is right.
 */
public data class Estimate(val name: String, val unit: String, val value: Double, val interval: Interval?) {
    public companion object {
        /** The upper end of an [interval] that has none. */
        public const val OPEN: Double = Double.MAX_VALUE
    }
}

/**
 * A model against the log.
 *
 * @property parameters its numbers. @property trainRmse root mean square of residuals over all rows, sensor units.
 * @property heldOutRmse the same over blocks it was not fitted to; NaN without a reference. @property
 * heldOutLogLikelihood of those, natural.
 * @property predicted what it shows along the log, sensor units, length n. Not to be modified.
 * @property noiseSpread standard deviation of the noise. @property noiseShare share of it that is correlated.
 * @property noiseTime over how long, s. @property whitened residuals without their correlation, standard deviations.
 * @property nullResiduals what [whitened] would be if the model were right.
 */
public class ModelAssessment internal constructor(
    public val parameters: List<Estimate>,
    public val trainRmse: Double,
    public val heldOutRmse: Double,
    public val heldOutLogLikelihood: Double,
    public val predicted: DoubleArray,
    public val noiseSpread: Double,
    public val noiseShare: Double,
    public val noiseTime: Double,
    public val whitened: DoubleArray,
    public val nullResiduals: NullResiduals,
) {
    internal fun of(rows: IntArray) =
        with(parameters, predicted.at(rows), whitened.at(rows), nullResiduals.of(rows))

    /** The same with other numbers and rows. */
    internal fun with(
        parameters: List<Estimate>,
        predicted: DoubleArray = this.predicted,
        whitened: DoubleArray = this.whitened,
        nullResiduals: NullResiduals = this.nullResiduals,
    ) = ModelAssessment(
        parameters,
        trainRmse,
        heldOutRmse,
        heldOutLogLikelihood,
        predicted,
        noiseSpread,
        noiseShare,
        noiseTime,
        whitened,
        nullResiduals,
    )
}

/**
 * A cause and how the log speaks for it.
 *
 * @property cause the cause. @property condition what it depends on, where that has a name.
 * @property parameters its numbers, if it were at work. @property trainRmse with it, sensor units.
 * @property heldOutRmse the same on held-out blocks; NaN where it was not taken, for the cause was not worth a look.
 * @property heldOutLogLikelihood of those blocks; NaN where it was not taken. @property pValue of its gain by chance; 0 of
 * rounding that readings show by themselves, all being on steps that make a quarter of the noise.
 * @property adjustedPValue for all causes tried, after Holm.
 * @property predicted what the model with it shows, sensor units, length n. Not to be modified.
 */
public class Candidate internal constructor(
    public val cause: Cause,
    public val condition: String?,
    public val parameters: List<Estimate>,
    public val trainRmse: Double,
    public val heldOutRmse: Double,
    public val heldOutLogLikelihood: Double,
    public val pValue: Double,
    public val adjustedPValue: Double,
    public val predicted: DoubleArray,
) {
    internal fun of(rows: IntArray) = with(parameters, predicted.at(rows))

    /** The same with other numbers and rows. */
    internal fun with(parameters: List<Estimate>, predicted: DoubleArray = this.predicted) =
        with(parameters, predicted, pValue, adjustedPValue)

    /** The same, where it is rounding, of readings that show that by themselves: which steps they are on is no chance. */
    internal fun surelyRounded(): Candidate =
        if (cause == Cause.QUANTISATION) with(parameters, predicted, 0.0, 0.0) else this

    /** The same with other numbers and rows, and as sure as [pValue] and [adjustedPValue] say. */
    internal fun with(
        parameters: List<Estimate>,
        predicted: DoubleArray,
        pValue: Double,
        adjustedPValue: Double,
    ) = Candidate(
        cause,
        condition,
        parameters,
        trainRmse,
        heldOutRmse,
        heldOutLogLikelihood,
        pValue,
        adjustedPValue,
        predicted,
    )
}

private fun DoubleArray.at(rows: IntArray) = DoubleArray(rows.size) { this[rows[it]] }

/**
 * What the reference says where the track crosses itself.
 *
 * @property later time between the two visits of each crossing, s, length n. Not to be modified.
 * @property higher how much higher the truth was on the second, sensor units, length n. Not to be modified.
 * @property rate of change that fits them best, sensor units/s; NaN where there are too few.
 */
public class Revisits internal constructor(
    public val later: DoubleArray,
    public val higher: DoubleArray,
    public val rate: Double,
)

/**
 * A cause of the extended model.
 *
 * @property cause the cause. @property parameters its numbers beside those of the others.
 */
public data class NamedEffect(val cause: Cause, val parameters: List<Estimate>)

/**
 * What a diagnosis found.
 *
 * @property verdict the answer. @property candidates every cause tried on the base, the likeliest first.
 * @property baseline the base model. @property extended the model with what was named; null where nothing was.
 * @property baseSensor the base as a sensor. @property extendedSensor the extended one; null where nothing was named.
 * @property separatingManoeuvre what would tell ambiguous causes apart; null where nothing is ambiguous.
 * @property dependences what is left in the residuals of the last model. @property spikes rows taken for outliers.
 * @property warnings for the reader. @property effects what the extended model holds beyond the base, with a reference.
 * @property revisits what the reference says of the water's own change; null without one.
 * @property mayHaveChanged whether a log without a reference is likelier where the water, or the sensor's zero, is let
 *   change, which is not named: a warning says so.
 */
public class DiagnosisResult internal constructor(
    public val verdict: Verdict,
    public val candidates: List<Candidate>,
    public val baseline: ModelAssessment,
    public val extended: ModelAssessment?,
    public val baseSensor: SensorSpec,
    public val extendedSensor: SensorSpec?,
    public val separatingManoeuvre: String?,
    public val dependences: List<Dependence>,
    public val spikes: List<Int>,
    public val warnings: List<String>,
    public val effects: List<NamedEffect> = emptyList(),
    public val revisits: Revisits? = null,
    public val mayHaveChanged: Boolean = false,
    internal val lag: ChannelLag? = null,
) {
    /** The same of the rows that [isRead] alone, of all where that is null, with [more] warnings. */
    internal fun ofRead(isRead: BooleanArray?, more: List<String>): DiagnosisResult {
        if (isRead == null && more.isEmpty()) return this
        val rows = baseline.predicted.indices.filter { isRead == null || isRead[it] }.toIntArray()
        return with(
            { it.of(rows) },
            { it.of(rows) },
            spikes.map { rows.binarySearch(it) },
            warnings + more,
        )
    }

    /** The same where [candidate] and [model] make others of candidates and of models. */
    internal fun with(
        candidate: (Candidate) -> Candidate,
        model: (ModelAssessment) -> ModelAssessment,
        spikes: List<Int> = this.spikes,
        warnings: List<String> = this.warnings,
    ): DiagnosisResult {
        val base = model(baseline)
        return DiagnosisResult(
            verdict,
            candidates.map(candidate),
            base,
            if (extended === baseline) base else extended?.let(model),
            baseSensor,
            extendedSensor,
            separatingManoeuvre,
            dependences,
            spikes,
            warnings,
            effects,
            revisits,
            mayHaveChanged,
            lag,
        )
    }
}
