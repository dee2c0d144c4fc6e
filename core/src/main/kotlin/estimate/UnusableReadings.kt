package stillwater.estimate

import kotlin.math.abs

/**
 * Readings from which a sensor's response is not to be learned: single wild ones, numbers that were written in
 * place of readings, and those at an end of the sensor's range. A sensor that follows slowly shows neither on its own;
 * so they are found in the readings as they are, before anything is learned.
 *
 * @property wild readings that stand off their neighbours, alone or with others of the same number, length n.
 * @property ends 1 for a reading at the upper end of the range, −1 at the lower end, else 0; length n.
 */
public class UnusableReadings(public val wild: BooleanArray, public val ends: ByteArray) {
    init {
        require(wild.size == ends.size) { "wild (${wild.size}) and ends (${ends.size}) must be of one length" }
    }

    /** Whether reading [i] is to be learned from. */
    public fun isUsable(i: Int): Boolean = !wild[i] && ends[i].toInt() == 0

    /** Whether there is any. */
    public val isNone: Boolean get() = wild.indices.all(::isUsable)

    /** The values of [series] with the [wild] ones put on the line between those before and after. */
    public fun bridged(series: TrackSeries): DoubleArray {
        val values = series.values.copyOf()
        val tame = wild.indices.filterNot(wild::get)
        if (tame.isEmpty()) return values
        var next = 0
        for (i in values.indices) {
            while (next < tame.lastIndex && tame[next] < i) next++
            if (!wild[i]) continue
            val after = tame[next]
            val before = if (after < i) after else tame[maxOf(0, next - 1)]
            val whole = series.times[after] - series.times[before]
            val share = if (before < i && i < after) (series.times[i] - series.times[before]) / whole else 0.0
            val from = series.values[if (i < before) after else before]
            values[i] = from + share * (series.values[after] - from)
        }
        return values
    }

    /** The same of a sensor that reads the other way round. */
    public fun mirrored(): UnusableReadings =
        UnusableReadings(wild, ByteArray(ends.size) { (-ends[it]).toByte() })

    public companion object {
        /** Nothing of [size] readings. */
        public fun none(size: Int): UnusableReadings = UnusableReadings(BooleanArray(size), ByteArray(size))

        /**
         * Those of [series].
         *
         * @param resolution step in which readings are rounded, sensor units, at least 0.
         * @param range the sensor's range where it is known, sensor units; ends that are infinite, and those
         * that no reading comes to, are looked for.
         */
        public fun of(
            series: TrackSeries,
            resolution: Double,
            range: ClosedFloatingPointRange<Double> = Double.NEGATIVE_INFINITY..Double.POSITIVE_INFINITY,
        ): UnusableReadings {
            if (series.size < FEWEST) return none(series.size)
            val wild = wild(series, resolution)
            val ends = ByteArray(series.size)
            for ((side, end) in listOf(1 to range.endInclusive, -1 to range.start)) {
                // An end that is no multiple of the last digit is read as the nearest one.
                val isAt =
                    BooleanArray(series.size) { end.isFinite() && side * (series.values[it] - end) >= -resolution / 2 }
                if (isAt.none { it }) mark(series.values, wild, side, ends)
                for (i in isAt.indices) if (isAt[i]) ends[i] = side.toByte()
            }
            return UnusableReadings(wild, ends)
        }

        /**
         * Readings outside nearly all of the three either way, by far more than readings there differ from each other
         * and than their usual scatter. A front is confirmed by what comes after it, and stays.
         */
        private fun wild(series: TrackSeries, resolution: Double): BooleanArray {
            val n = series.size
            val values = series.values
            val near = Array(n) { beside(series, it, null) }
            val off = DoubleArray(n) { abs(values[it] - (median(near[it].map(values::get).sorted()) ?: values[it])) }
            val limits = DoubleArray(n) { i ->
                val local = off.copyOfRange(maxOf(0, i - WINDOW), minOf(n, i + WINDOW + 1)).apply { sort() }
                TIMES_SCATTER * (NORMAL * local[local.size / 2] + resolution)
            }
            val outside = DoubleArray(n) { i -> outside(values[i], near[i].map(values::get).sorted(), 1) }
            // On a steep stretch two wild readings make the next row look wild; without them it is among the others.
            val candidates = BooleanArray(n) { i ->
                fun others() = near[i].filter { outside[it] <= limits[it] || 2 * outside[it] < outside[i] }
                outside[i] > limits[i] && outside(values[i], others().map(values::get).sorted(), 0) > limits[i]
            }
            return BooleanArray(n) { i -> candidates[i] && isAlone(series, i, candidates) }
                .also { addCodes(values, resolution, it) }
        }

        /**
         * Marks runs of one number, and single readings at an end of the log, that come and go in one row by more than
         * nearly all other readings spread: what is written for a probe that was off or not heard (0, 9999). Water
         * that is seen in more than one row is not twice the same.
         */
        private fun addCodes(values: DoubleArray, resolution: Double, wild: BooleanArray) {
            val sorted = values.filterIndexed { i, _ -> !wild[i] }.sorted()
            if (sorted.isEmpty()) return
            val low = sorted[(TAIL * (sorted.size - 1)).toInt()]
            val high = sorted[((1 - TAIL) * (sorted.size - 1)).toInt()]
            val reach = maxOf(high - low, TIMES_SCATTER * resolution)
            if (!(reach > 0)) return
            var i = 0
            while (i < values.size) {
                var end = i + 1
                while (end < values.size && values[end] == values[i]) end++
                val isOff = maxOf(values[i] - high, low - values[i]) > reach
                val comes = i == 0 || abs(values[i] - values[i - 1]) > reach
                val goes = end == values.size || abs(values[end] - values[end - 1]) > reach
                val isSingleWithin = end == i + 1 && i > 0 && end < values.size
                if (isOff && comes && goes && !isSingleWithin) wild.fill(true, i, end)
                i = end
            }
        }

        /** How far [value] is outside of the [sorted] ones but the first and the last [trimmed] of them. */
        private fun outside(value: Double, sorted: List<Double>, trimmed: Int): Double =
            if (sorted.size < 2 + 2 * trimmed) {
                0.0
            } else {
                maxOf(value - sorted[sorted.size - 1 - trimmed], sorted[trimmed] - value)
            }

        /** Readings within three rows of [i], not itself, without those that [but] has, in order. */
        private fun beside(series: TrackSeries, i: Int, but: BooleanArray?): List<Int> =
            (maxOf(0, i - BESIDE)..minOf(series.size - 1, i + BESIDE)).filter {
                it != i && but?.get(it) != true &&
                    abs(series.times[it] - series.times[i]) <= BESIDE * series.gapLimit
            }

        private fun median(sorted: List<Double>): Double? =
            if (sorted.isEmpty()) null else (sorted[(sorted.size - 1) / 2] + sorted[sorted.size / 2]) / 2

        private fun isAlone(series: TrackSeries, i: Int, candidates: BooleanArray): Boolean {
            val rows = beside(series, i, candidates)
            // At an end of the log nothing says that it came back.
            if (rows.count { it < i } < 2 || rows.count { it > i } < 2) return false
            val near = rows.map { series.values[it] }
            val beyond = maxOf(series.values[i] - near.max(), near.min() - series.values[i])
            val largestStep = (1 until near.size).maxOf { abs(near[it] - near[it - 1]) }
            return beyond > TIMES_STEP * largestStep
        }

        /**
         * Marks the readings at the upper ([side] 1) or lower (−1) end of the range: the extreme reading, if it comes
         * again and again at a stretch as no other value does.
         */
        private fun mark(values: DoubleArray, wild: BooleanArray, side: Int, ends: ByteArray) {
            val usable = values.indices.filter { !wild[it] }
            val extreme = usable.maxOf { side * values[it] }
            val opposite = usable.maxOf { -side * values[it] }
            val counts = HashMap<Double, Int>()
            var run = 0
            var longestAtEnd = 0
            var longestElsewhere = 0
            for ((k, i) in usable.withIndex()) {
                run = if (k > 0 && values[usable[k - 1]] == values[i]) run + 1 else 1
                counts.merge(values[i], 1, Int::plus)
                if (side * values[i] == extreme) {
                    longestAtEnd = maxOf(longestAtEnd, run)
                } else if (-side * values[i] != opposite) {
                    longestElsewhere = maxOf(longestElsewhere, run)
                }
            }
            val atEnd = counts.getValue(side * extreme)
            val most = counts.filterKeys { side * it != extreme && -side * it != opposite }.values.maxOrNull() ?: return
            val isEnd = longestAtEnd >= FEWEST_AT_END && longestAtEnd > TIMES_LONGER * longestElsewhere &&
                atEnd > TIMES_OFTENER * most
            if (!isEnd) return
            for (i in values.indices) if (side * values[i] >= extreme) ends[i] = side.toByte()
        }

        private const val FEWEST = 30
        private const val BESIDE = 3
        private const val WINDOW = 50
        private const val NORMAL = 1.4826

        /** So far off no reading of normal noise is in a thousand logs. */
        private const val TIMES_SCATTER = 8.0

        /** What a narrow patch of water leaves in the rows beside it is a third of its height at the least. */
        private const val TIMES_STEP = 3.0

        /** Numbers that are no readings are in fewer rows than this share, either way. */
        private const val TAIL = 0.05
        private const val FEWEST_AT_END = 5

        /** The hump of a smooth signal stays at its extreme for a few times as long as elsewhere, too. */
        private const val TIMES_LONGER = 2

        /**
         * A smooth crest that just fills the last digit is there 1 / (√2 − 1) = 2.4 times as often as one digit below;
         * counts of a few rows differ by chance besides.
         */
        private const val TIMES_OFTENER = 4
    }
}
