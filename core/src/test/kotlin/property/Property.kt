package stillwater.property

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.RandomSource
import io.kotest.property.arbitrary.arbitrary
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import kotlin.random.Random

/** The seed of every property test of core: the same cases each run. A failure prints it with the case. */
internal const val SEED = 20_260_101L

/** Checks [law] on [cases] values of [arb]; what fails is printed with the seed, and shrunk where [arb] can. */
internal fun <A> forEvery(arb: Arb<A>, cases: Int = 200, law: (A) -> Unit) {
    runBlocking {
        checkAll(PropTestConfig(seed = SEED, iterations = cases), arb) { law(it) }
    }
}

/** As [forEvery] of one, for pairs. */
internal fun <A, B> forEvery(first: Arb<A>, second: Arb<B>, cases: Int = 200, law: (A, B) -> Unit) {
    runBlocking {
        checkAll(PropTestConfig(seed = SEED, iterations = cases), first, second) { a, b -> law(a, b) }
    }
}

/** As [forEvery] of one, for triples. */
internal fun <A, B, C> forEvery(
    first: Arb<A>,
    second: Arb<B>,
    third: Arb<C>,
    cases: Int = 200,
    law: (A, B, C) -> Unit,
) {
    runBlocking {
        checkAll(PropTestConfig(seed = SEED, iterations = cases), first, second, third) { a, b, c -> law(a, b, c) }
    }
}

/** Cases that [make] draws, none of them an edge case; the case must say in toString what it is. */
internal fun <A> drawn(make: (Random) -> A): Arb<A> = arbitrary { source: RandomSource -> make(source.random) }

/** A number from [lower] until [upper]. */
internal fun Random.between(lower: Double, upper: Double): Double = lower + (upper - lower) * nextDouble()
