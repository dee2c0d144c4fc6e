package stillwater.diagnosis

/**
 * Numbers that a logger writes where it has no reading, 99999 or a thermometer's -127: the same to the last digit again and
 * again, far beyond all others of the column, come and gone from one row to the next.
 */
internal object WrittenCodes {
    /** How far off such a number is, in all that the others reach over. */
    private const val BEYOND = 10.0

    /** Fewer of one number are single wild readings. */
    private const val FEWEST = 3

    /** Different codes at most at each side. */
    private const val CODES = 2

    /** Rows in a row at most, on average: water, or a sample, of one value that a probe was moved to is there for longer. */
    private const val LONGEST = 10

    /** Of all numbers at most. */
    private const val MOST = 0.5

    /** Nines alone are no reading, however long they last. */
    private val NINES = Regex("""-?99+(\.9+|\.0)?""")

    /**
     * The codes in [column], of which NaN are missing, and of which [truth], empty where there is none, tells what may be
     * real; in order.
     */
    fun of(column: DoubleArray, truth: DoubleArray = DoubleArray(0)): List<Double> {
        val known = column.filter { it.isFinite() }
        val counts = known.groupingBy { it }.eachCount().toSortedMap()
        val values = counts.keys.toDoubleArray()
        val wanted = (0..2 * CODES).flatMap { all -> (0..all).map { it to all - it } }
            .filter { (low, high) -> low + high > 0 && low <= CODES && high <= CODES && low + high < values.size - 1 }
        // Seldom asked for, and a look at each number's digits.
        val real by lazy { truth.filter { it.isFinite() && !isNines(it) } }
        for ((low, high) in wanted) {
            val codes = values.take(low) + values.takeLast(high)
            if (codes.sumOf { counts.getValue(it) } > MOST * known.size) continue
            val ends = listOf(values[low], values[values.size - 1 - high])
            if (!areFar(codes, ends) || codes.any { counts.getValue(it) < FEWEST || !isCode(it, column) }) continue
            if (areFar(codes, ends + real)) return codes
        }
        return emptyList()
    }

    private fun areFar(codes: List<Double>, others: List<Double>): Boolean {
        val least = others.min()
        val most = others.max()
        val reach = BEYOND * (most - least)
        return reach > 0 && codes.all { it < least - reach || it > most + reach }
    }

    private fun isNines(number: Double) = NINES.matches(number.toBigDecimal().toPlainString())

    private fun isCode(number: Double, column: DoubleArray): Boolean {
        val runs = column.indices.count { column[it] == number && (it == 0 || column[it - 1] != number) }
        return isNines(number) || column.count { it == number } <= LONGEST * runs
    }
}

/**
 * The rows of [read] in which a code stands for the reading of the column [quantity], or for the truth of [reference].
 */
internal class CodedRows(read: LogColumns, quantity: String, reference: String?) {
    // What is a code of the reference alone says nothing of what readings may be.
    private val alone = WrittenCodes.of(read.reference) - WrittenCodes.of(read.values).toSet()
    private val codes = WrittenCodes.of(read.values, read.reference.filter { it !in alone }.toDoubleArray())

    /** Rows whose reading is one. */
    val isRead: BooleanArray = BooleanArray(read.size) { read.values[it] in codes }

    private val readings = read.values.filterIndexed { i, _ -> !isRead[i] }.toDoubleArray()
    private val wrong = WrittenCodes.of(read.reference, readings)

    /** Rows whose truth is one. */
    val isTold: BooleanArray = BooleanArray(read.size) { read.reference[it] in wrong }

    /** Whether row [i] has one. */
    fun isIn(i: Int): Boolean = isRead[i] || isTold[i]

    /** How many rows have one. */
    val rows: Int = isRead.indices.count(::isIn)

    /** What is said of them, without full stops. */
    val notes: List<String> = listOfNotNull(words(codes, quantity, isRead), reference?.let { words(wrong, it, isTold) })

    private fun words(codes: List<Double>, column: String, rows: BooleanArray): String? {
        if (codes.isEmpty()) return null
        val numbers = codes.joinToString(" or ") { it.toBigDecimal().stripTrailingZeros().toPlainString() }
        return "the column $column has $numbers in ${rows.count { it }} rows, far beyond all others: " +
            "taken for what is written where there is no number, and left out"
    }
}
