package stillwater.diagnose.blind

import stillwater.diagnose.Loops
import stillwater.diagnose.SineTrack
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Designs give up their columns, and are given up themselves, where others were asked for since; their answers stay. */
class BlindColumnsTest {
    private val n = 150
    private val series = SineTrack(n).series
    private val scales = Scales(series)
    private val used = BooleanArray(n) { true }
    private val track = SmoothTrack.of(series)

    /** Of two sizes, so that space of one does not do for the other. */
    private val waters = listOf(30, 50).map { WaterModes.flat(series, track, it) }

    /** More than are kept: lags of 1, 2, ... s, by turns under noise that is white and that wanders. */
    private val asked = List(MANY) { k ->
        val noise = CorrelatedNoise(series.times, if (k % 2 == 0) 0.0 else 0.6, 5.0, used)
        val rows = IntArray(n) { if (it in 40..60) ShownRows.NONE else it }
        Asked(1.0 + k, waters[k / 2 % 2], if (k % 3 == 0) ShownRows(rows) else null, noise)
    }

    private inner class Asked(
        private val lag: Double,
        private val modes: WaterModes,
        private val rows: ShownRows?,
        noise: CorrelatedNoise,
    ) {
        private val noise = BlindNoise(noise, DoubleArray(n) { 1.0 + it % 2 })

        fun of(columns: BlindColumns) =
            columns.designed(
                columns.shown(emptyList(), doubleArrayOf(lag, 1.0, 0.0, 0.0), modes, Steps.EVEN),
                rows,
                noise,
            )
    }

    private fun columns() = BlindColumns(series, scales, Loops.IN_TURN)

    private fun assertSameAnswers(expected: BlindDesign, found: BlindDesign, which: String) {
        val random = Random(SEED)
        val heights = DoubleArray(expected.size) { random.nextDouble(-1.0, 1.0) }
        val white = DoubleArray(n) { random.nextDouble(-1.0, 1.0) }
        for (a in expected.gram.indices) assertContentEquals(expected.gram[a], found.gram[a], which)
        assertContentEquals(expected.transposed(white), found.transposed(white), which)
        assertContentEquals(expected.times(heights), found.times(heights), which)
        val rows = expected.rows(50, 60) zip found.rows(50, 60)
        for ((own, other) in rows) assertContentEquals(own, other, which)
    }

    @Test
    fun whatWasAskedForLongAgoIsAnsweredAsByOneThatIsNew() {
        val shared = columns()
        val designs = asked.map { it.of(shared) }
        // To and fro: each takes the space of another.
        for (k in designs.indices + designs.indices.reversed() + listOf(0, MANY - 1, 0, 1)) {
            assertSameAnswers(asked[k].of(columns()), designs[k], "design $k")
        }
    }

    @Test
    fun theNewestAreKeptAndOlderOnesMadeAnew() {
        val shared = columns()
        val designs = asked.map { it.of(shared) }
        // The newest first: so none that is kept is given up for one that is made anew.
        val isKept = designs.indices.reversed().map { k ->
            val again = asked[k].of(shared)
            assertSameAnswers(designs[k], again, "design $k")
            again === designs[k]
        }
        assertTrue(isKept.first() && !isKept.last(), "$isKept")
        assertEquals(isKept.sortedDescending(), isKept)
    }

    private companion object {
        const val SEED = 20261122
        const val MANY = 40
    }
}
