package stillwater.closedloop

import stillwater.mission.MissionState
import stillwater.mission.StopReason
import java.util.Locale

/** Runs seeds through the fault campaign; see docs/safety.md for the command. */
internal object FaultCampaign {
    private const val MOST_TRACE = 400
    private val rows = FaultKind.entries.map { setOf(it) } + listOf(FaultKind.entries.toSet())

    /** The faults of run [seed]: one kind after the other, then all at once. */
    fun kinds(seed: Long): Set<FaultKind> = rows[(seed % rows.size).toInt()]

    fun run(seed: Long): RunResult = CampaignRun(CampaignCase(seed), kinds(seed)).run()

    /** A line for each kind of fault. */
    fun table(results: List<RunResult>): String = buildString {
        appendLine(
            "| fault | runs | occurred | beyond margin | motors too long | readings lost | exceptions " +
                "| bounds made wrong (right) | worst time to zero, s (v4.2.0) " +
                "| worst excursion driven (drifting), m | readings | missions completed |",
        )
        appendLine("|---|" + "---|".repeat(11))
        for (kinds in rows) line(kinds, results.filter { it.kinds == kinds })
        if (results.isNotEmpty()) line(null, results)
    }

    private fun StringBuilder.line(kinds: Set<FaultKind>?, results: List<RunResult>) {
        if (results.isEmpty()) return
        val name = if (kinds == null) "together" else kinds.singleOrNull()?.label ?: "all at once"
        val count = results.sumOf { run -> run.kinds.sumOf { run.occurred[it.ordinal].toLong() } }
        val lost = results.sumOf { it.verdicts.run { lostInRecovery + mapsApart + unlogged } + it.wrongStamps }
        val completed = results.count { it.end == MissionState.Stopped(StopReason.COMPLETED) }
        appendLine(
            listOf(
                name,
                results.size,
                count,
                results.sumOf { it.observer.beyondMargin },
                results.sumOf { it.observer.tooLong },
                lost,
                results.count { it.exception != null },
                results.sumOf { it.verdicts.spoiltBounds }.toString() +
                    " (${results.sumOf { it.verdicts.mendedBounds }})",
                seconds(results.filter { !it.isSlowBoard }) + " (" + seconds(results.filter { it.isSlowBoard }) + ")",
                "%.1f (%.1f)".format(
                    Locale.ROOT,
                    results.maxOf { it.observer.worstDriven },
                    results.maxOf { it.observer.worstDrifted },
                ),
                results.sumOf { it.verdicts.readings },
                completed,
            ).joinToString(" | ", "| ", " |"),
        )
    }

    private fun seconds(results: List<RunResult>) =
        "%.2f".format(Locale.ROOT, results.maxOfOrNull { it.observer.worstTimeToZero } ?: 0.0)

    /** What a run was, in a line. */
    fun summary(run: RunResult): String = listOf(
        run.case.seed,
        run.kinds.singleOrNull()?.name ?: "ALL",
        run.case.spec.estimator,
        run.case.spec.planner,
        run.case.mixing,
        run.end,
        "${run.verdicts.readings} readings (${run.verdicts.badTaken.size} bad${bad(run)})",
        "%.1f m beyond driven, %.1f m drifted, %.0f s under power".format(
            Locale.ROOT,
            run.observer.worstDriven,
            run.observer.worstDrifted,
            run.observer.underPower,
        ),
    ).joinToString(" ")

    private fun bad(run: RunResult) =
        run.verdicts.badTaken.joinToString("") { (taken, sent) -> ", $taken for $sent" }

    /** What is wrong with a run, in a line; empty where nothing is. */
    fun faultsFound(run: RunResult): String = listOfNotNull(
        "beyond the margin".takeIf { run.observer.beyondMargin > 0 },
        "motors for ${run.observer.worstTimeToZero} s".takeIf { run.observer.tooLong > 0 },
        "lost in recovery".takeIf { run.verdicts.lostInRecovery > 0 },
        "${run.verdicts.mapsApart} cells apart from the log's".takeIf { run.verdicts.mapsApart > 0 },
        "${run.verdicts.unlogged} lines not in the log".takeIf { run.verdicts.unlogged > 0 },
        "${run.verdicts.spoiltBounds} bounds made wrong".takeIf { run.verdicts.spoiltBounds > 0 },
        "${run.wrongStamps} stamps wrong".takeIf { run.wrongStamps > 0 },
        run.exception?.stackTraceToString()?.take(MOST_TRACE),
    ).joinToString("; ")
}

/**
 * `FIRST COUNT [EVERY [all]]`: prints the table of COUNT seeds, each EVERY-th (1) from FIRST on; on the other stream
 * each run in which something is wrong, or all.
 */
fun main(arguments: Array<String>) {
    val first = arguments[0].toLong()
    val results = ArrayList<RunResult>()
    val every = arguments.getOrNull(2)?.toLong() ?: 1
    for (seed in List(arguments[1].toInt()) { first + it * every }) {
        val run = FaultCampaign.run(seed)
        results += run
        val found = FaultCampaign.faultsFound(run)
        if (found.isNotEmpty() || arguments.size > 3) System.err.println("${FaultCampaign.summary(run)}: $found")
        if (results.size % HUNDRED == 0) System.err.println(FaultCampaign.table(results))
    }
    print(FaultCampaign.table(results))
}

private const val HUNDRED = 100
