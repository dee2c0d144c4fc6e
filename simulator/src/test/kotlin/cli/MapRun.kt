package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import java.nio.file.Path

/** Runs `stillwater map` with [arguments] as typed by a user. */
internal fun runMap(vararg arguments: String): CliktCommandTestResult =
    Stillwater().subcommands(MapCommand()).test(listOf("map") + arguments)

/** The output directory that tests of refusals name and that must not come to be. */
internal fun Path.out(): Path = resolve("results")

/** A small lawnmower survey: legs north and south, [rows] rows of 1 s, columns as the reader knows them. */
internal fun smallSurvey(rows: Int = 200): String = buildString {
    appendLine("time_s,lat_deg,lon_deg,do_mg_l")
    for (i in 0 until rows) {
        val leg = i / LEG_ROWS
        val along = if (leg % 2 == 0) i % LEG_ROWS else LEG_ROWS - 1 - i % LEG_ROWS
        val value = 8 + 0.01 * along + 0.002 * leg
        appendLine("$i,${45.5 + along * 1e-5},${-73.1 + leg * 5e-5},$value")
    }
}

private const val LEG_ROWS = 40
