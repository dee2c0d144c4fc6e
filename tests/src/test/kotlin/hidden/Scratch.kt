package stillwater.hidden

import stillwater.diagnose.*
import stillwater.io.*
import java.nio.file.*

fun main(args: Array<String>) {
    val from = args[0].toLong()
    val count = args[1].toInt()
    val only = args.getOrNull(2)
    val dir = Files.createTempDirectory("hidden")
    var time = 0L
    for (seed in from until from + count) {
        val case = HiddenCase(seed, true)
        val t = case.truth
        if (only == "none" && t.effects.isNotEmpty()) continue
        if (!only.isNullOrEmpty() && only != "none" && only != "all" && t.effects.keys.none { it.label == only }) continue
        val file = dir.resolve("case.csv")
        case.write(file)
        args.getOrNull(4)?.let { Files.copy(file, Path.of(it), StandardCopyOption.REPLACE_EXISTING) }
        val start = System.nanoTime()
        val log = SurveyLog.open(file, LogChoice(value = "value", conditions = mapOf("reference" to "reference", "speed" to "speed_mps", "temperature" to "temperature_c", "salinity" to "salinity", "heading" to "heading_rad")))
        val r = log.readings()
        fun col(n: String) = DoubleArray(r.size) { r[it].conditions[n] }
        val s = MeasuredSeries(
            DoubleArray(r.size) { r[it].time.seconds }, DoubleArray(r.size) { r[it].position.x }, DoubleArray(r.size) { r[it].position.y },
            DoubleArray(r.size) { r[it].value }, col("reference"),
            listOf("speed", "temperature", "salinity", "heading").associateWith { col(it) },
        )
        val d = Diagnosis(s).run()
        time += System.nanoTime() - start
        val v = d.verdict
        val got = when (v) { is Verdict.Named -> v.causes.map { it.label }.toString(); is Verdict.Ambiguous -> v.sets.map { s -> s.map { it.label } }.toString(); is Verdict.Unexplained -> v.what; is Verdict.InsufficientData -> v.why; else -> "" }
        if (args.getOrNull(3) != null) { println("  base heldout %.3f %.5f".format(d.baseline.heldOutLogLikelihood, d.baseline.heldOutRmse)); d.candidates.take(4).forEach { c -> println("   ${c.cause.label} ${c.parameters.map { it.name + "=" + "%.4g".format(it.value) + " " + it.interval }} train %.5f held %.5f p %.2e ll %.3f".format(c.trainRmse, c.heldOutRmse, c.adjustedPValue, c.heldOutLogLikelihood)) } }
        println("$seed ${t.track} n=${s.size} tau=%.1f TRUE ".format(t.timeConstant) + t.effects.entries.joinToString { "${it.key.label}=%.3g(%.2fx)".format(it.value, t.multiples[it.key]) } + " | ${v.label} $got | " +
            d.candidates.take(3).joinToString { "${it.cause.label}:%.1e".format(it.adjustedPValue) } + " | left ${d.dependences[0].description.take(30)} %.1f %.1e".format(d.dependences[0].ratio, d.dependences[0].adjusted) + " | tau %.2f noise %.2f/%.1f".format(d.baseline.parameters[0].value, d.baseline.noiseShare, d.baseline.noiseTime))
    }
    println("mean %.0f ms".format(time / 1e6 / count))
}
