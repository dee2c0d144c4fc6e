package stillwater.estimate

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Which passes a run of a track is held against. */
class RevisitBlocksTest {
    /** Legs of 80 m at 1 m/s, up and down in turn, at [places] across; half a minute between them. */
    private fun nodes(vararg places: Double): TrackNodes {
        val rows = places.flatMapIndexed { leg, x ->
            (0..80).map { i -> doubleArrayOf(leg * 110.0 + i, x, if (leg % 2 == 0) i.toDouble() else 80.0 - i) }
        }
        fun column(k: Int) = DoubleArray(rows.size) { rows[it][k] }
        val values = DoubleArray(rows.size) { it % 7.0 }
        return TrackNodes(PhaseCorrection(TrackSeries(column(0), column(1), column(2), values)), thinning = 1)
    }

    /** Places across of the runs that blocks amidst the leg at [x] are held against. */
    private fun against(x: Double, nodes: TrackNodes): Set<List<Double>> =
        RevisitBlocks(nodes, mostBlocks = 150).find()
            .filter { nodes.xs[it.start] == x && nodes.ys[it.start] in 30.0..50.0 }
            .map { block -> block.firsts.dropLast(1).map { nodes.xs[it] }.sorted() }.toSet()

    @Test
    fun legsAreHeldAgainstThoseOnEitherSide() {
        assertEquals(setOf(listOf(0.0, 20.0)), against(10.0, nodes(0.0, 10.0, 20.0, 30.0)))
    }

    @Test
    fun legsInPairsAreHeldAgainstTheNextPairAsWell() {
        val nodes = nodes(0.0, 10.0, 40.0, 50.0)
        // Against its own pair only, water at a slant is a delay.
        assertEquals(setOf(listOf(0.0, 40.0)), against(10.0, nodes))
        assertEquals(setOf(listOf(10.0, 50.0)), against(40.0, nodes))
    }

    @Test
    fun whatIsVeryFarIsNoPass() {
        val far = against(10.0, nodes(0.0, 10.0, 400.0, 410.0))
        assertTrue(far.isNotEmpty() && far.all { 400.0 !in it }, "$far")
    }

    @Test
    fun runsBesideAGapAreToldFromOthers() {
        // Legs of 81 rows each; the first and the last row of the log are no gap.
        val nodes = nodes(0.0, 10.0)
        assertEquals(listOf(false, false, true), listOf(0..11, 40..51, 60..71).map { nodes.isNearGap(it, 15.0) })
        assertEquals(listOf(true, false, false), listOf(81..92, 110..121, 150..161).map { nodes.isNearGap(it, 15.0) })
    }
}
