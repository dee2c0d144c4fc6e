package stillwater.speed

import stillwater.model.Grid
import java.lang.management.ManagementFactory

/**
 * Prints how long a boat with a Bayesian map waits for a decision, as the cells and the readings grow: tab separated, a
 * line for each grid and number of moves, processor time of the one thread in ms.
 *
 * The first decision, which makes the tables of correlations, is told apart; the others are those of all moves so far.
 */
fun main() {
    val threads = ManagementFactory.getThreadMXBean()
    println("cells\tmoves\treadings\tfirst_ms\tmean_ms\tp99_ms\tworst_ms\tbytes")
    // A smaller one first, so that the code is compiled.
    repeat(2) { BayesianSurvey(Grid.unit(20, 20)).apply { repeat(WARM_UP) { move() } } }
    for ((columns, rows) in listOf(10 to 10, 40 to 25, 50 to 50, 100 to 100)) {
        val before = used()
        val survey = BayesianSurvey(Grid.unit(columns, rows))
        val times = ArrayList<Double>()
        for (moves in 1..MOST_MOVES) {
            val begin = threads.currentThreadCpuTime
            survey.move()
            times += (threads.currentThreadCpuTime - begin) / NANOSECONDS
            if (moves !in SHOWN) continue
            val sorted = times.drop(1).sorted()
            val line = listOf(times[0], sorted.average(), sorted[sorted.size * 99 / 100], sorted.last())
            val numbers = line.joinToString("\t") { "%.3f".format(it) }
            println("${columns * rows}\t$moves\t${moves * Survey.SAMPLES}\t$numbers\t${used() - before}")
        }
        // So that it is in use up to here.
        survey.move()
    }
}

private fun used(): Long {
    repeat(2) { System.gc() }
    return Runtime.getRuntime().run { totalMemory() - freeMemory() }
}

private const val WARM_UP = 400
private const val MOST_MOVES = 2000
private const val NANOSECONDS = 1e6
private val SHOWN = setOf(250, 500, 1000, 2000)
