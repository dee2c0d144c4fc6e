package stillwater.diagnose.reference

import stillwater.diagnose.track.SmoothCourse

/**
 * A reference that is written in steps, as by a meter with one decimal: the truth is within half a step of each number, and
 * smooth, which says more than the numbers alone. Where slow water stays on one number for many rows and goes on to the next it
 * must have risen all the while.
 *
 * @param reference the truth to a [step], its own units. @param isBroken whether a course starts anew at a row, length n.
 */
internal class RoundedReference(
    private val reference: DoubleArray,
    private val step: Double,
    private val isBroken: BooleanArray,
) {
    /** Smooth courses within the steps, one for each of some stiffnesses; own units. */
    fun courses(): List<DoubleArray> = STIFFNESSES.map(::course)

    /** Projections onto smooth courses and onto what the steps allow, in turn. */
    private fun course(stiffness: Double): DoubleArray {
        var course = SmoothCourse(reference, isBroken).of(stiffness)
        repeat(TURNS) {
            val within = DoubleArray(reference.size) { i ->
                course[i].coerceIn(reference[i] - step / 2, reference[i] + step / 2)
            }
            course = SmoothCourse(within, isBroken).of(stiffness)
        }
        return course
    }

    private companion object {
        const val TURNS = 20

        /** From waves of some five rows, which halve, to those of some two hundred. */
        val STIFFNESSES = List(13) { Math.pow(10.0, it.toDouble()) }
    }
}
