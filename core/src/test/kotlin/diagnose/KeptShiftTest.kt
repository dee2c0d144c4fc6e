package stillwater.diagnose

import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import kotlin.math.abs
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class KeptShiftTest {
    private val track = CrossingTrack(300)
    private val period = 2.0
    private val series =
        MeasuredSeries(DoubleArray(300) { period * it }, track.x, track.y, track.truth, track.truth)
    private val scales = Scales(series)

    private fun model(cause: Cause, steps: Steps) = ResponseModel(series, listOf(Term(cause)), steps, scales)

    private fun numbers(model: ResponseModel, shift: Double) =
        DoubleArray(model.parameters.size).also {
            it[ResponseModel.TIME_CONSTANT] = 10.0
            it[ResponseModel.GAIN] = 1.0
            it[model.slot(model.terms.single())] = shift
        }

    /** The law of it: readings of the same waters are as late, whichever way steps go. */
    @Test
    fun readingsAreAsLateWhicheverWayStepsGo() {
        val ways = Steps.entries.flatMap { from -> Steps.entries.map { from to it } }
        for (cause in SmallShifts.WHOLE) {
            for ((from, to) in ways) {
                val model = model(cause, from)
                val before = numbers(model, shift = 3.0)
                val kept = SmallShifts.kept(model, before, to)
                assertEquals(late(model, before, from), late(model, kept, to), 1e-9, "$cause from $from to $to")
            }
        }
    }

    /** How late readings are, s. */
    private fun late(model: ResponseModel, numbers: DoubleArray, steps: Steps) =
        checkNotNull(SmallShifts.late(model.terms.single(), model, numbers)) - steps.lead * period

    @Test
    fun whatTheModelShowsIsNearlyTheSame() {
        val held = model(Cause.DEAD_TIME, Steps.HELD)
        val even = model(Cause.DEAD_TIME, Steps.EVEN)
        val before = numbers(held, shift = 3.0)
        fun shown(model: ResponseModel, numbers: DoubleArray) = DoubleArray(300).also { model.predict(numbers, it) }
        val wanted = shown(held, before)
        fun farthest(other: DoubleArray) = (100 until 300).maxOf { abs(other[it] - wanted[it]) }
        val kept = farthest(shown(even, SmallShifts.kept(held, before, Steps.EVEN)))
        assertTrue(kept < 0.1 * farthest(shown(even, before)), "$kept")
    }

    /** A dead time of a quarter of a row ahead of a held truth is none where steps are even. */
    @Test
    fun aDelayStaysWithinItsBounds() {
        val model = model(Cause.DEAD_TIME, Steps.HELD)
        val slot = model.slot(model.terms.single())
        val kept = SmallShifts.kept(model, numbers(model, shift = period / 4), Steps.EVEN)
        assertEquals(model.parameters[slot].lower, kept[slot])
    }

    @Test
    fun aModelWithoutAShiftIsAsItWas() {
        val model = model(Cause.HYSTERESIS, Steps.EVEN)
        val before = numbers(model, shift = 0.1)
        assertTrue(before.contentEquals(SmallShifts.kept(model, before, Steps.HELD)))
    }
}
