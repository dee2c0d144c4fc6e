package stillwater.contract

import io.kotest.property.PropTestConfig
import io.kotest.property.RandomSource
import io.kotest.property.arbitrary.arbitrary
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import stillwater.field.FieldMap
import kotlin.random.Random

/** The seed of every law and contract: the same cases each run. A failure prints it with the case. */
internal const val SEED = 20_260_102L

/** Checks [law] on [cases] cases that [make] draws; a case must say in toString what it is. */
internal fun <A> forEvery(cases: Int, make: (Random) -> A, law: (A) -> Unit) {
    runBlocking {
        checkAll(
            PropTestConfig(seed = SEED, iterations = cases),
            arbitrary { source: RandomSource ->
                make(source.random)
            },
        ) { law(it) }
    }
}

/** A number from [lower] until [upper]. */
internal fun Random.between(lower: Double, upper: Double): Double = lower + (upper - lower) * nextDouble()

/** One of the numbers a sensor, a clock or a receiver should never give, or a common one. */
internal fun Random.hostile(lower: Double, upper: Double): Double = when (nextInt(12)) {
    0 -> Double.NaN
    1 -> Double.POSITIVE_INFINITY
    2 -> Double.NEGATIVE_INFINITY
    3 -> 1e300
    4 -> -1e300
    5 -> Double.MIN_VALUE
    6 -> -0.0
    else -> between(lower, upper)
}

/** All a map says of one cell. */
internal data class CellContent(
    val value: Double,
    val lower: Double,
    val upper: Double,
    val visits: Int,
    val readings: Int,
    val conflicts: Int,
)

/** All a map says, cell by cell; equal contents are equal to the last bit. */
internal fun content(map: FieldMap): List<CellContent> = List(map.grid.size) {
    CellContent(map.value(it), map.lower(it), map.upper(it), map.visits(it), map.readings(it), map.conflicts(it))
}
