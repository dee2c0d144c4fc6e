package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import java.nio.file.Path
import kotlin.io.path.readLines
import kotlin.test.assertEquals

/** Runs `stillwater benchmark` with [arguments] as typed by a user. */
internal fun runBenchmark(vararg arguments: String): CliktCommandTestResult =
    Stillwater().subcommands(BenchmarkCommand()).test(listOf("benchmark") + arguments)

/** Runs it into [out] with 2 environments of 12 moves unless [flags] say otherwise; it must succeed. */
internal fun runSmallBenchmark(out: Path, vararg flags: String): CliktCommandTestResult {
    val small = listOf("--out", out.toString(), "--environments", "2", "--moves", "12", "--threads", "1")
    // A flag given twice counts as given last.
    return runBenchmark(*(small + flags).toTypedArray()).also { assertEquals(0, it.statusCode, it.output) }
}

/** The rows of results.csv in [out] by the names of the columns. */
internal fun results(out: Path): List<Map<String, String>> {
    val lines = out.resolve("results.csv").readLines().map { it.split(',') }
    return lines.drop(1).map { row -> lines.first().zip(row).toMap() }
}
