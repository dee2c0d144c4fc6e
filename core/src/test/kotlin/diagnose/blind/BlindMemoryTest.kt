package stillwater.diagnose.blind

import stillwater.diagnose.Loops
import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.test.Test
import kotlin.test.assertNotSame
import kotlin.test.assertNull

class BlindMemoryTest {
    private val memory = BlindMemory(ROWS)

    /** A design of two columns, which keeps them in [memory] from the beginning. */
    private fun design(): BlindDesign {
        val white = CorrelatedNoise(DoubleArray(ROWS) { it.toDouble() }, 0.0, 1.0, BooleanArray(ROWS) { true })
        val noise = BlindNoise(white, DoubleArray(ROWS) { 1.0 })
        return BlindDesign(2, noise, Loops.IN_TURN, memory) { columns -> columns.forEach { it.fill(1.0) } }
    }

    @Test
    fun columnsInUseAreNotGivenAwayWhenAnotherUserOfTheSameDesignLeaves() {
        val design = design()
        val forgotten = checkNotNull(memory.taken(design))
        // They are in use when others take the room.
        repeat(MANY) { design() }
        assertNull(memory.taken(design))
        val anew = memory.space(design)
        memory.keep(design, anew)
        memory.left(design, forgotten)
        repeat(2 * MANY) {
            val space = memory.space(design)
            assertNotSame(anew, space)
            val other = design()
            memory.left(other, space)
        }
    }

    private companion object {
        const val ROWS = 10
        const val MANY = 6
    }
}
