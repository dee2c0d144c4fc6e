package stillwater.diagnosis

import stillwater.diagnose.Cause
import stillwater.diagnose.ChannelLags
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.Estimate
import stillwater.diagnose.ModelAssessment
import stillwater.diagnose.Verdict
import stillwater.report.SignificantDigits
import stillwater.report.counted
import stillwater.sensor.SensorStage
import kotlin.math.abs

/**
 * A log and what the diagnosis says about it, in words.
 *
 * @property log the log. @property result the diagnosis. @property worth what the better model is worth for a map, or
 * null.
 * @property channels how late other channels of the boat are, or null. @param isGiven whether the base is a sensor that
 * was given. @param unit of the readings, or null.
 */
class Diagnosed(
    val log: DiagnosisLog,
    val result: DiagnosisResult,
    val worth: MapWorth?,
    private val isGiven: Boolean = false,
    val channels: ChannelLags? = null,
    private val unit: String? = null,
) {
    /** Checks of what the best model leaves. */
    internal val checks by lazy { ResidualChecks(best, result.baseline, log.columns.values) }

    /** The extended model; the base where nothing was named. */
    val best: ModelAssessment get() = result.extended ?: result.baseline

    /** The quantity with its unit. */
    val quantity: String = if (unit == null) log.quantity else "${log.quantity} ($unit)"

    /** The unit after a number, with a blank before it; empty without one. */
    val unitAfter: String = unit?.let { " $it" }.orEmpty()

    /** What a residual is, with its unit. */
    val residualLabel: String = "Measured less predicted" + unit?.let { " ($it)" }.orEmpty()

    /**
     * Labels of the causes of the answer: those named, the certain ones of an ambiguous answer; `none`,
     * `unexplained`.
     */
    val causes: List<String> = when (val verdict = result.verdict) {
        is Verdict.Named -> verdict.causes.map { it.label }
        is Verdict.Ambiguous -> verdict.sets.filter { it.size == 1 }.map { it.single().label }
        is Verdict.Consistent -> listOf("none")
        is Verdict.Unexplained -> listOf("unexplained")
        is Verdict.InsufficientData -> emptyList()
    }

    /** What the reader must know beside the answer. */
    val warnings: List<String> = buildList {
        addAll(result.warnings)
        addAll(chosenForTheFile())
        worth?.takeIf { it.isWorse }?.let {
            add(
                "For a map by the interval filter the extended model is no gain, for that knows its limits alone; " +
                    "what undoes the sensor's response is the command correct, with --sensor extended-sensor.json.",
            )
        }
        channels?.let { add(ChannelWording.of(it)) }
        log.heading?.let { add(it.sentence) }
        // What was taken for what in a log that is not written plainly is not to be found in the report alone.
        if (',' in log.format) add("The log was read as ${log.format}.")
        for ((reason, count) in log.pass.skipped) add("${counted(count, "row")} left out: $reason.")
        for (warning in log.pass.warnings + log.bridged) add("${warning.replaceFirstChar { it.uppercase() }}.")
        if (log.steps.missing > 0) {
            add("${counted(log.steps.missing, "row")} left out: no number in the column ${log.reference}.")
        }
        if (log.steps.isSparse) {
            add(
                "How the truth went between the rows with one is not known: up to half their distance may look like " +
                    "a delay or an offset of place.",
            )
        }
        if (log.cut > 0) {
            val were = if (log.cut == 1L) "was" else "were"
            add("${counted(log.cut, "row")} at the end $were not looked at: ${DiagnosisLog.MOST_ROWS} are the most.")
        }
    }

    /** That the sensor file holds what may as well be the water's, one sentence for each. */
    private fun chosenForTheFile(): List<String> {
        val held = result.extended?.parameters.orEmpty().map { it.name }
        return result.verdict.ambiguity.filter { Cause.TIME_VARYING_FIELD in it }.mapNotNull { set ->
            val own = set.firstOrNull { cause -> alone(cause).any { it.name != TIME_CONSTANT && it.name in held } }
            own?.let {
                "extended-sensor.json holds the ${it.label}, though the water may have changed instead: " +
                    "what is given that file takes it for the sensor's."
            }
        }
    }

    /** The answer in one sentence. */
    val answer: String = when (val verdict = result.verdict) {
        is Verdict.Named -> verdict.causes.joinToString(" ") { sentence(it) }
        is Verdict.Ambiguous -> verdict.sets.joinToString(" ") { set ->
            if (set.size == 1) {
                sentence(set.single())
            } else {
                open(set)
            }
        }
        is Verdict.Consistent ->
            "Nothing that the simulation lacks shows in this log${besideLag()}" +
                if (result.mayHaveChanged) "; but the water may have changed meanwhile." else "."
        is Verdict.Unexplained ->
            (
                listOf("Something is at work that no cause of the list explains: ${verdict.what}.") +
                    verdict.ambiguity.map { open(it) }
                ).joinToString(" ")
        is Verdict.InsufficientData -> "This log cannot show it: ${verdict.why}."
    }

    /** A lag that was fitted is the simulation's, and no cause; who has a slow sensor wants to hear of it first. */
    private fun besideLag(): String {
        val tau = result.baseline.parameters.firstOrNull { it.name == TIME_CONSTANT }
        val lowest = tau?.interval?.lower ?: 0.0
        return if (isGiven || tau == null || lowest <= 0) "" else ", beside the lag of ${number(tau)} itself"
    }

    private fun open(set: List<Cause>) = if (!isGiven && set.toSet() == LAG) {
        // Which kind of lag it is is open; that there is one is what a slow sensor's owner knows, and no fault.
        "The readings lag the water, by a time constant or by a dead time; this track cannot tell which."
    } else {
        "One of ${set.joinToString(", ") { it.label }} is at work; this track cannot tell which."
    }

    private fun sentence(cause: Cause): String {
        val parameters = result.effects.firstOrNull { it.cause == cause }?.parameters ?: alone(cause)
        val own = result.extendedSensor?.let { CauseInWords(it, unitAfter).of(cause) }
        val all = listOfNotNull(numbers(parameters).ifEmpty { null }, own).joinToString("; ")
        return (wrong(cause) ?: cause.sentence) + if (all.isEmpty()) "" else " ($all)"
    }

    /**
     * The numbers of [cause] as it was fitted alone; beside others, which change what the lag is and how much noise is left,
     * those that are its own.
     */
    private fun alone(cause: Cause): List<Estimate> {
        val parameters = result.candidates.firstOrNull { it.cause == cause }?.parameters.orEmpty()
        return when {
            result.effects.isEmpty() -> parameters
            cause == Cause.QUANTISATION -> emptyList()
            else -> parameters.filter { it.name != TIME_CONSTANT }
        }
    }

    /** Of a sensor that was given with a number for [cause], that this number is wrong; null of others. */
    private fun wrong(cause: Cause): String? {
        if (!isGiven) return null
        val found = result.baseSensor.stages.firstOrNull { stage ->
            when (cause) {
                Cause.DEAD_TIME -> stage is SensorStage.Delay
                Cause.ASYMMETRIC_RESPONSE -> stage is SensorStage.Asymmetric
                Cause.TWO_PATH_RESPONSE -> stage is SensorStage.TwoPath
                Cause.FLOW_DEPENDENT_RESPONSE -> stage is SensorStage.FlowLag
                Cause.TEMPERATURE_DEPENDENT_RESPONSE -> stage is SensorStage.TemperatureLag
                Cause.HYSTERESIS -> stage is SensorStage.Backlash
                Cause.SLEW_LIMIT -> stage is SensorStage.Slew
                Cause.DRIFT -> stage is SensorStage.Drifting
                else -> false
            }
        } ?: return null
        val was = (found as? SensorStage.Delay)?.let { ", ${SignificantDigits(3).format(it.deadTime)} s," }.orEmpty()
        return "The sensor given is wrong in its ${cause.label}$was and shows another one here."
    }

    /** Whether there is a base model: of a log that cannot show anything none is fitted, and it has no residuals. */
    val isFitted: Boolean get() = result.baseline.parameters.isNotEmpty()

    /** Whether nothing that was named changes how the base model follows the water. */
    val isBaseNamed: Boolean get() = result.extended === result.baseline

    /** What the extended sensor has beside such a base, in words; empty for nothing. */
    val besideBase: String
        get() = listOf(Cause.OUTLIERS to "the outliers", Cause.QUANTISATION to "the rounding")
            .filter { (cause, _) -> cause.label in causes }
            .joinToString("") { (_, words) -> ", with $words" }

    /** How the sensor's gain and offset are off the reference; null where they are not clearly, or were given. */
    val calibration: String? = when {
        log.reference == null -> null
        // What is not understood, or hardly there, is no calibration.
        result.verdict is Verdict.Unexplained || result.verdict is Verdict.InsufficientData -> null
        else -> Calibration(this).words()
    }

    /** [parameters] in words. */
    fun numbers(parameters: List<Estimate>): String = parameters.joinToString(", ") { "${name(it)} ${number(it)}" }

    /** What [estimate] is of, in words; its unit stands behind the number. */
    fun name(estimate: Estimate): String =
        estimate.name.removeSuffix("_per_s").removeSuffix("_s").removeSuffix("_m").replace('_', ' ')

    /** The number of [estimate] with its interval and unit. */
    fun number(estimate: Estimate): String {
        val digits = digits(estimate)
        val reach = estimate.interval?.let {
            when {
                it.upper == Estimate.OPEN -> " [above ${digits.format(it.lower)}]"
                it.lower > 0 && it.upper / it.lower > HARDLY -> " [hardly known]"
                else -> " [${digits.format(it.lower)}, ${digits.format(it.upper)}]"
            }
        }.orEmpty()
        val unit = if (estimate.unit.isEmpty()) "" else " ${inUnit(estimate.unit)}"
        return "${digits.format(estimate.value)}$reach$unit"
    }

    /** Three digits, or as many more as tell the ends of its interval apart: an end of a range is known to a few thousandths. */
    private fun digits(estimate: Estimate): SignificantDigits {
        val all = (3..MOST_DIGITS).map(::SignificantDigits)
        val reach = estimate.interval ?: return all.first()
        return all.firstOrNull { it.format(reach.lower) != it.format(reach.upper) } ?: all.first()
    }

    /** [words] of a unit, with the readings' own in it where it is known. */
    fun inUnit(words: String): String = if (unit == null) words else words.replace(SENSOR_UNITS, unit)

    /** Five lines for the terminal, and one more where the [calibration] is off. */
    fun lines(): List<String> {
        val three = SignificantDigits(3)
        val base = result.baseline
        val after = result.extended
        val tau = base.parameters.firstOrNull { it.name == TIME_CONSTANT }
        val best = result.candidates.firstOrNull()
        val sensor = if (isGiven) "the sensor given" else "lag of ${tau?.let(::number) ?: "unknown length"}"
        return listOfNotNull(
            "verdict: ${result.verdict.label}" + if (causes.isEmpty()) "" else " (${causes.joinToString(", ")})",
            answer,
            if (!isFitted) {
                "base: nothing was fitted"
            } else {
                "base: $sensor; residuals " +
                    three.format(base.trainRmse) + unitAfter + heldOut(base, three) + " (root mean square)"
            },
            calibration,
            when {
                after != null -> extension(base, after, three)
                best == null -> "no cause was tried"
                else ->
                    "likeliest of ${result.candidates.size} causes tried: ${best.cause.label}, adjusted p " +
                        three.format(best.adjustedPValue)
            },
            result.separatingManoeuvre?.let { "to tell them apart: $it" }
                ?: result.dependences.firstOrNull()?.let {
                    "what is left depends most on ${it.description}, adjusted p ${three.format(it.adjusted)}"
                } ?: "nothing else was looked at",
        )
    }

    /** Where too little was there nothing is held out. */
    private fun heldOut(model: ModelAssessment, three: SignificantDigits) =
        if (model.heldOutRmse.isNaN()) "" else ", on held-out blocks ${three.format(model.heldOutRmse)}$unitAfter"

    private fun extension(base: ModelAssessment, after: ModelAssessment, three: SignificantDigits): String =
        if (after === base) {
            "extended: the base's own lag$besideBase"
        } else {
            val gain = after.heldOutLogLikelihood - base.heldOutLogLikelihood
            val tau = after.parameters.firstOrNull { it.name == TIME_CONSTANT }
            val lag = if (tau == null) "" else "lag of ${number(tau)}; "
            "extended: ${lag}held-out residuals ${three.format(after.heldOutRmse)}$unitAfter, log-likelihood " +
                "${three.format(abs(gain))} ${if (gain < 0) "lower" else "higher"}"
        }

    private companion object {
        /** What numbers are in whose unit nobody said. */
        const val SENSOR_UNITS = "sensor units"

        /** The upper end of an interval over the lower one from which numbers say nothing. */
        const val HARDLY = 1e6

        /** Significant digits of a number whose interval is narrow. */
        const val MOST_DIGITS = 6

        const val TIME_CONSTANT = "time_constant_s"

        /** The kinds of a lag. */
        val LAG = setOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME)
    }
}
