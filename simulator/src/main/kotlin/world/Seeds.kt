package stillwater.world

import kotlin.random.Random

/**
 * Independent random streams from one seed, so that a result depends on the seed and not on the order of the work.
 *
 * Each stream is named by a label and numbers; the same name gives the same stream. Mixed by SplitMix64's finaliser
 * (Steele, Lea, Flood 2014, doi:10.1145/2714064.2660195).
 *
 * @property seed the experiment's seed.
 */
class Seeds(val seed: Long) {
    /** The stream called [label] of the items [indices]. */
    fun random(label: String, vararg indices: Int): Random {
        var state = mix(seed)
        for (character in label) state = mix(state xor character.code.toLong())
        for (index in indices) state = mix(state xor index.toLong())
        return Random(state)
    }

    private fun mix(value: Long): Long {
        var z = value + GOLDEN_GAMMA
        z = (z xor (z ushr 30)) * -0x40a7b892e31b1a47L
        z = (z xor (z ushr 27)) * -0x6b2fb644ecceee15L
        return z xor (z ushr 31)
    }

    private companion object {
        const val GOLDEN_GAMMA = -0x61c8864680b583ebL
    }
}
