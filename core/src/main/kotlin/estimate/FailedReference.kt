package stillwater.estimate

import kotlin.math.abs

/**
 * Numbers of a reference that are none of the water: where a fast sensor fails, or its plug is loose, it jumps off and comes
 * back, by far more than it moves otherwise and, there or near by, beyond all that it shows else, and the readings beside it show
 * nothing of that.
 */
public object FailedReference {
    /**
     * Rows of [reference], one number a row as the [readings], NaN where there is none, in which it failed; in order.
     *
     * @throws IllegalArgumentException if the two are not as long as each other.
     */
    public fun rows(readings: DoubleArray, reference: DoubleArray): List<Int> {
        require(readings.size == reference.size) {
            "readings (${readings.size}) must be as many as numbers of the reference (${reference.size})"
        }
        val known = reference.indices.filter { reference[it].isFinite() }
        if (known.size < FEWEST) return emptyList()
        val moves = known.zipWithNext { before, after -> abs(reference[after] - reference[before]) }
        val usual = moves.filter { it > 0 }.sorted().let { it.getOrNull(it.size / 2) } ?: return emptyList()
        val runs = runs(known, reference, FAR * usual)
        val wild = impossible(known, runs, reference)
        val failed = runs.filter { run -> wild.any { it in run.first - NEAR..run.last + NEAR } }
            .filterNot { shows(known, it, readings) }.flatMap { run -> run.map { known[it] } }
        return failed.takeIf { it.size <= MOST * known.size }.orEmpty()
    }

    /** Those of the [known] rows in [runs] that are farther beyond all others than these reach. */
    private fun impossible(known: List<Int>, runs: List<IntRange>, reference: DoubleArray): List<Int> {
        val off = runs.flatten().toSet()
        val others = known.indices.filter { it !in off }.map { reference[known[it]] }
        val reach = others.max() - others.min()
        return off.filter { reference[known[it]] !in others.min() - reach..others.max() + reach }
    }

    /** That it failed in [count] rows, for the reader. */
    public fun words(count: Int): String {
        val rows = if (count == 1) "1 row" else "$count rows"
        return "in $rows the reference jumps off and back, which the readings do not show: it is taken to have " +
            "failed there, and says nothing of the sensor"
    }

    /** Stretches of [known] rows that are off those before and behind by more than [far] a row. */
    private fun runs(known: List<Int>, reference: DoubleArray, far: Double): List<IntRange> {
        val runs = ArrayList<IntRange>()
        var good = 0
        var i = 1
        while (i < known.size) {
            if (abs(reference[known[i]] - reference[known[good]]) <= far * (i - good)) {
                if (i > good + 1) runs += good + 1 until i
                good = i
            } else if (i - good > LONGEST || isSteady(known, reference, good + 1..i, far)) {
                // It went there and stays.
                good = i
            }
            i++
        }
        // Where the log ends nothing shows whether it came back.
        if (good < known.lastIndex) runs += good + 1..known.lastIndex
        return runs
    }

    /** Whether the last rows of [run] are as near to each other as others are: a move that is none of a failing sensor. */
    private fun isSteady(known: List<Int>, reference: DoubleArray, run: IntRange, far: Double): Boolean =
        run.last - run.first >= STEADY - 1 && (run.last - STEADY + 2..run.last).all {
            abs(reference[known[it]] - reference[known[it - 1]]) <= far
        }

    /** Whether the [readings] move by more than usual within and after the [run]: then the water was so. */
    private fun shows(known: List<Int>, run: IntRange, readings: DoubleArray): Boolean {
        val span = run.last - run.first + AFTER
        fun moved(from: Int): Double {
            val before = readings[known[from]]
            return (from..minOf(from + span, known.lastIndex)).maxOf { abs(readings[known[it]] - before) }
        }
        val apart = maxOf(1, known.size / SAMPLES)
        val others = (0 until known.size - span step apart).map(::moved).sorted()
        val usual = others.getOrNull((USUALLY * others.size).toInt()) ?: return true
        return moved(maxOf(run.first - 1, 0)) > usual
    }

    private const val FEWEST = 30

    /** Rows about one that no water has, in which a reference that jumps has failed, too. */
    private const val NEAR = 100

    /** Times what the reference usually moves by from row to row. */
    private const val FAR = 30.0

    /** Rows that a stretch has at the most. */
    private const val LONGEST = 20

    /** So many rows in a row that agree are the water's. */
    private const val STEADY = 3

    /** Of all rows: a reference that fails oftener is not one that fails now and then. */
    private const val MOST = 0.05

    /** Rows after a stretch in which a sensor shows it. */
    private const val AFTER = 10
    private const val SAMPLES = 500

    /** Of all stretches as long: readings that move by more than in these show something. */
    private const val USUALLY = 0.8
}
