package stillwater.allocation

import org.junit.jupiter.api.Test
import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.StopCondition
import stillwater.wire.LineFramer
import stillwater.wire.PlatypusCodec
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertTrue

/** What runs on the boat for hours besides filters and planners of the usual size, see [AllocationTest]. */
class BoatAllocationTest {
    private val line = """{"s1":{"type":"atlas_do","data":"7.42"}}""" + "\r\n"

    @Test
    fun linesOutOfBytes() {
        var heard = 0
        val framer = LineFramer({ _, start, end -> heard += end - start })
        val bytes = (line + line).encodeToByteArray()
        AllocationMeter.assertNone("bytes in pieces of any length") {
            val cut = 1 + it % (bytes.size - 1)
            framer.accept(bytes, 0, cut)
            framer.accept(bytes, cut)
        }
        assertTrue(heard > 0)
    }

    @Test
    fun aDecodedLineIsItsMessageAndNoMore() {
        var heard = 0
        val framer = LineFramer(PlatypusCodec { heard++ })
        val bytes = line.encodeToByteArray()
        val allocated = AllocationMeter.bytes { framer.accept(bytes) }
        assertTrue(heard >= AllocationMeter.CALLS)
        // An object with a number of four and one of eight bytes, on any JVM, and as much again for a list or a text.
        assertTrue(allocated <= 64L * AllocationMeter.CALLS, "$allocated bytes in ${AllocationMeter.CALLS} lines")
    }

    @Test
    fun aLargeTreeOnceWarm() {
        val grid = Grid.unit(10, 10)
        val filter = BoundedFilter(grid, Interval.UNIT, BoundedFilterSettings(epsilon = 1e-4))
        repeat(3000) {
            val cell = it / 10 * 7 % grid.size
            filter.update(BoatTime(it.toDouble()), grid.centerX(cell), grid.centerY(cell), 0.5 + 0.4 * sin(it * 0.03))
        }
        val planner = BoundedPlanner(Random(3), BoundedPlannerSettings(expansions = 2000))
        val plan = Plan()
        val centers = List(grid.size) { grid.center(it) }
        var moves = 0L
        AllocationMeter.assertNone("a decision of 2000 expansions") {
            planner.plan(filter.map, centers[it % grid.size], 0.5, StopCondition.NEVER, plan)
            moves += plan.size
        }
        assertTrue(moves > AllocationMeter.CALLS)
    }
}
