package stillwater.diagnose

import stillwater.diagnose.blind.BlindDiagnosis
import stillwater.diagnose.blind.GivenDelay
import stillwater.diagnose.blind.GivenLag
import stillwater.diagnose.blind.LongDelay
import stillwater.diagnose.reference.GivenSensor
import stillwater.diagnose.reference.ReferenceDiagnosis
import stillwater.estimate.FailedReference

/**
 * Finds what a simulation gets wrong about a measured log, by name.
 *
 * A first-order lag with gain and offset, or the given sensor, is fitted to the log under noise of which a part may be
 * correlated. Each cause is then a nested extension: fitted, weighed by its likelihood ratio corrected for what
 * correlation the noise model has missed, for the number of causes tried (Holm) and held to a gain on held-out blocks.
 * The best is added and the search goes on. What the extended model still leaves is looked through for dependences of
 * any kind. Derivation in core/docs/Diagnosis.md.
 *
 * Pure: the same log gives the same answer. Cost: of the order of a second for a thousand rows.
 *
 * @param loops how what can be done at once is; the answer is the same bits.
 * @param progress told how much is done, a share within 0..1 that grows; at most a few hundred times.
 * @throws IllegalArgumentException if there is a reference and parts of the given sensor would be lost, or take a
 *   condition that [series] has not; the message is for the user.
 */
public class Diagnosis(
    series: MeasuredSeries,
    private val settings: DiagnosisSettings = DiagnosisSettings(),
    private val loops: Loops = Loops.IN_TURN,
    private val progress: (Double) -> Unit = {},
) {
    private val series = series.fromStart()

    init {
        val given = settings.base
        if (series.reference != null && given != null) GivenSensor.requireKnown(given, series.conditions.keys)
    }

    /** The answer. Without a reference the field is inferred together with the sensor. */
    public fun run(): DiagnosisResult {
        val reference = series.reference ?: return withoutReference().also { progress(1.0) }
        val sane = series.withoutWild()
        val truth = sane.reference ?: reference
        val wrong = reference.indices.count { truth[it] != reference[it] }
        val failed = FailedReference.rows(sane.values, truth)
        val notes = listOfNotNull(
            WildNumbers.words(wrong).takeIf { wrong > 0 },
            words(failed.size).takeIf { failed.isNotEmpty() },
        )
        val known = sane.withoutFailed(failed)
        val answer = ReferenceDiagnosis(known, settings, loops, 0.0, progress = progress).answer()
        return answer.ofRead(series.isRead, notes).also { progress(1.0) }
    }

    /** That the reference failed in so many [rows], as a sentence. */
    private fun words(rows: Int) = FailedReference.words(rows).replaceFirstChar(Char::uppercase) + "."

    private fun withoutReference(): DiagnosisResult {
        val given = settings.base ?: return LongDelay(series, settings, loops, progress).answer()
        if (GivenLag.delay(given) > 0) return GivenDelay(series, settings, given, loops, progress).answer()
        return BlindDiagnosis(series, settings, loops, progress).run()
    }
}
