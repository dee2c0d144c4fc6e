package stillwater.io

/** Counts the numbers in columns of conditions that stand for none, such as -9999. */
internal class ConditionCodes(private val columns: CsvColumns) {
    private val names = columns.conditions.keys.toList()
    private val counts = LongArray(names.size)

    /** One more in the condition [i]. */
    fun count(i: Int) {
        counts[i]++
    }

    /** What to say of them. */
    fun notes(): List<String> = names.indices.filter { counts[it] > 0 }.map { i ->
        val column = columns.names[columns.conditions.getValue(names[i])]
        "column $column has ${counts[i]} numbers that stand for none, such as -9999: ${names[i]} is " +
            "taken for unknown there"
    }
}
