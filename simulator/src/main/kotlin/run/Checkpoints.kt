package stillwater.run

/** The moves at which errors are taken unless others are asked for. */
object Checkpoints {
    /** Those that the reproduction is judged at. */
    val NAMED: List<Int> = listOf(50, 100, 200, 500, 1000, 2000)

    private val TENTHS = listOf(10, 12, 15, 20, 25, 30, 40, 50, 60, 70, 80, 90)

    /** About a dozen in every decade, [NAMED] among them, and [moves] itself. */
    fun upTo(moves: Int): List<Int> {
        val all = sortedSetOf(moves)
        var decade = 1L
        while (decade <= moves) {
            for (tenths in TENTHS) {
                val move = decade * tenths
                if (move % 10 == 0L && move / 10 <= moves) all += (move / 10).toInt()
            }
            decade *= 10
        }
        return all.toList()
    }
}
