package stillwater.hidden

import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random

/** Normal numbers of unit spread, [period] s apart, whose correlation fades over [time] s. */
internal class Wander(private val random: Random, period: Double, time: Double) {
    private val keep = exp(-period / time)
    private var state = random.normal()

    /** The next one. */
    fun next(): Double {
        state = keep * state + sqrt(1 - keep * keep) * random.normal()
        return state
    }
}
