package stillwater.diagnosis

/** How far the rows of a log are from each other, s, and those of them at which the reference is known. */
internal class ReferenceSteps {
    private val all = ArrayList<Double>()
    private val known = ArrayList<Double>()

    /** Rows without a reference. */
    val missing: Int get() = all.size - known.size

    /**
     * Whether the reference comes more rarely than the readings, so that the truth between its rows must be guessed. A
     * row missing here and there, or a reference that stops for a while, leaves the most of them as near as they were:
     * what is not known there is a gap's.
     */
    val isSparse: Boolean get() = missing > 0 && isSparse(usual(known), usual(all))

    /** Takes the row at [time], s; rows come in order. */
    fun add(time: Double, isKnown: Boolean) {
        all += time
        if (isKnown) known += time
    }

    companion object {
        /** Rows with a reference are this much rarer than rows before what lies between them counts. */
        private const val SPARSE = 1.5

        /** The median of the steps between [times], s, which are in order; 0 where there is none. */
        fun usual(times: List<Double>): Double {
            val steps = times.zipWithNext { before, after -> after - before }.sorted()
            return if (steps.isEmpty()) 0.0 else steps[steps.size / 2]
        }

        /** Whether rows with a reference, usually [known] s apart, are sparse among rows that are usually [all] s apart. */
        fun isSparse(known: Double, all: Double): Boolean = known > SPARSE * all
    }
}
