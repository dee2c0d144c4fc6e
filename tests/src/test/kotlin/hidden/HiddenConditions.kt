package stillwater.hidden

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * What the field does to a log besides any effect: rows that are missing, one by one and in gaps; a receiver whose fixes
 * come less often than readings and stand still between; errors of fixes that wander; noise with tails; a probe that
 * was let down from the air when the log began.
 *
 * Each of them is drawn by dice of their own, so that all else of a case is what it is without them.
 */
internal class HiddenConditions(seed: Long, private val rows: Int, private val period: Double) {
    private val random = Random(seed * 7919 + DICE)
    private val missing = if (random.nextDouble() < 0.3) 0.01 + 0.04 * random.nextDouble() else 0.0
    private val gaps = if (random.nextBoolean()) List(1 + random.nextInt(3)) { gap() } else emptyList()
    private val held = if (random.nextDouble() < 0.4) 2 + random.nextInt(4) else 1
    private val wandering = if (random.nextBoolean()) 0.2 + 0.6 * random.nextDouble() else 0.0
    private val wanderTime = between(30.0, 120.0)
    private val freedom = if (random.nextBoolean()) 4 + random.nextInt(3) else null

    /** How far from the first water the sensor is when the log begins, in spreads of the water; by dice of its own. */
    val start: Double = Random(seed * 7919 + AIR).let { dice ->
        if (dice.nextBoolean()) (2 + 6 * dice.nextDouble()) * if (dice.nextBoolean()) 1 else -1 else 0.0
    }

    private fun between(from: Double, to: Double) = exp(ln(from) + random.nextDouble() * ln(to / from))

    private fun gap(): IntRange {
        val length = between(5.0, 120.0).toInt()
        val first = AT_ENDS + random.nextInt(rows - length - 2 * AT_ENDS)
        return first until first + length
    }

    private val written = BooleanArray(rows) { row -> random.nextDouble() >= missing && gaps.none { row in it } }

    /** Whether [row] is in the log. */
    fun isWritten(row: Int): Boolean = written[row]

    /** Whether [row] has a fix of its own; else it has that of the row before. */
    fun isFixed(row: Int): Boolean = row % held == 0

    /** Errors of the fixes that wander, m, one a row. */
    fun wander(): DoubleArray {
        val wander = Wander(random, period, wanderTime)
        return DoubleArray(rows) { wandering * wander.next() }
    }

    /** What a normal number is multiplied by for noise of the same spread with Student's tails; 1 without tails. */
    fun tail(): Double {
        val nu = freedom ?: return 1.0
        val squares = (1..nu).sumOf { random.normal().let { it * it } }
        return sqrt((nu - 2) / squares)
    }

    /** The conditions in few words. */
    override fun toString(): String = listOfNotNull(
        gaps.takeIf { it.isNotEmpty() }?.let { "gaps of ${it.map { gap -> gap.last - gap.first + 1 }} rows" },
        "%.1f %% of rows missing".format(100 * missing).takeIf { missing > 0 },
        "fixes held for $held rows".takeIf { held > 1 },
        "fixes wander by %.2f m".format(wandering).takeIf { wandering > 0 },
        freedom?.let { "tails of $it degrees of freedom" },
        "begun %.1f spreads away".format(start).takeIf { start != 0.0 },
    ).joinToString().ifEmpty { "none" }

    private companion object {
        /** The dice for conditions. */
        const val DICE = 5

        /** The dice for where the sensor begins. */
        const val AIR = 6

        /** So many rows at either end have no gap. */
        const val AT_ENDS = 40
    }
}
