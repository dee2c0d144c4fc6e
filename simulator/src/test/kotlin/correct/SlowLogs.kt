package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import stillwater.cli.CorrectCommand
import stillwater.cli.Stillwater
import java.nio.file.Path
import kotlin.io.path.readLines
import kotlin.io.path.writeText

/** Logs with the columns time_s, x_m, y_m, slow and truth in [directory], each corrected into `results` there. */
internal class SlowLogs(private val directory: Path) {
    /** Corrects the log that is [text]. */
    fun correct(text: String): CliktCommandTestResult {
        val file = directory.resolve("log.csv").also { it.writeText(text) }.toString()
        val arguments = listOf("correct", file, "--value", "slow", "--out", directory.resolve("results").toString())
        return Stillwater().subcommands(CorrectCommand()).test(arguments)
    }

    /** Share of rows whose interval holds the truth. */
    fun held(): Double {
        val rows = directory.resolve("results/corrected.csv").readLines().drop(1).map { line ->
            line.split(",").map { it.toDouble() }
        }
        return rows.count { it[4] in it[6]..it[7] }.toDouble() / rows.size
    }
}
