package stillwater.estimate

import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

class FitInPartsTest {
    private val grid = Grid.unit(8, 8)

    /** Truths, readings ten a cell along rows in turn, twice, each a second after the one before, of a lag of 6 s. */
    private class Survey(grid: Grid, seed: Int, rising: Double = 6.0, falling: Double = 6.0) {
        private val random = Random(seed)
        val truths = DoubleArray(grid.size) { random.nextDouble() }
        val cells = IntArray(20 * grid.size) {
            val place = it / 10 % grid.size
            val row = place / grid.columns
            val along = place % grid.columns
            row * grid.columns + if (row % 2 == 0) along else grid.columns - 1 - along
        }
        private var state = truths[0]
        val values = DoubleArray(cells.size) {
            val gap = truths[cells[it]] - state
            state += (1 - exp(-1 / if (gap > 0) rising else falling)) * gap
            state + 0.004 * (random.nextDouble() + random.nextDouble() - 1)
        }
    }

    private fun SelfCalibratingEstimator.take(survey: Survey, from: Int = 0, until: Int = survey.cells.size) = apply {
        for (i in from until until) {
            // A gap: the boat was away.
            if (i == 700) update(BoatTime(699.5), -50.0, -50.0, 0.5, Conditions.NONE)
            val cell = survey.cells[i]
            update(BoatTime(i.toDouble()), grid.centerX(cell), grid.centerY(cell), survey.values[i], Conditions.NONE)
        }
    }

    private fun estimator(work: Double, recalled: Int = 2048) =
        SelfCalibratingEstimator(grid, Interval.UNIT, SelfCalibratingSettings(recalled = recalled), work)

    private fun SelfCalibratingEstimator.error(survey: Survey) =
        (0 until grid.size).sumOf { abs(map.value(it) - survey.truths[it]) } / grid.size

    @Test
    fun aFitInPartsThatHasTimeIsTheOneAtOnceToTheLastBit() {
        val survey = Survey(grid, 5201)
        // A reading is enough for a fit of 100 readings, and less than 913 for one of 609.
        val atOnce = estimator(SelfCalibratingEstimator.AT_ONCE).take(survey, until = 900)
        val inParts = estimator(1e9).take(survey, until = 900)
        assertEquals(atOnce.timeConstant, inParts.timeConstant)
        for (cell in 0 until grid.size) {
            assertEquals(atOnce.map.value(cell), inParts.map.value(cell))
            assertEquals(atOnce.map.upper(cell), inParts.map.upper(cell))
        }
    }

    @Test
    fun whileAFitIsUnderWayReadingsCountAndNoneIsLost() {
        for (sensor in listOf(6.0 to 6.0, 8.0 to 4.0)) {
            val survey = Survey(grid, 5202, sensor.first, sensor.second)
            val atOnce = estimator(SelfCalibratingEstimator.AT_ONCE).take(survey)
            for (work in listOf(500.0, SelfCalibratingEstimator.AFLOAT)) {
                val inParts = estimator(work).take(survey)
                // One was fitted to all of the first 913 readings, the other to some of them fewer.
                val apart = abs(ln(inParts.timeConstant / atOnce.timeConstant))
                assertTrue(apart < 3 * atOnce.relativeUncertainty, "$sensor, $work: $apart")
                assertEquals(
                    atOnce.sensor().candidates.first().kind,
                    inParts.sensor().candidates.first().kind,
                    "$sensor, $work",
                )
                assertTrue(inParts.error(survey) < 1.1 * atOnce.error(survey) + 1e-4, "$sensor, $work")
                assertEquals(survey.cells.size, (0 until grid.size).sumOf { inParts.map.readings(it) })
            }
        }
    }

    @Test
    fun theSameReadingsGiveTheSameBitsAgain() {
        val survey = Survey(grid, 5203, 8.0, 4.0)
        val first = estimator(2000.0).take(survey, until = 1000)
        val again = estimator(2000.0).take(survey, until = 500).also { it.map.value(3) }.take(survey, 500, 1000)
        assertEquals(first.timeConstant, again.timeConstant)
        for (cell in 0 until grid.size) assertEquals(first.map.value(cell), again.map.value(cell))
    }

    @Test
    fun aFitIsCompleteBeforeAReadingWouldBeLostToIt() {
        val survey = Survey(grid, 5204)
        // So little that no fit of 271 readings comes to an end by itself before the 300 that are kept are full.
        val inParts = estimator(1.0, recalled = 300).take(survey)
        val atOnce = estimator(SelfCalibratingEstimator.AT_ONCE, recalled = 300).take(survey)
        assertEquals(6.0, inParts.timeConstant, 0.2)
        assertTrue(inParts.error(survey) < 1.1 * atOnce.error(survey) + 1e-4, "${inParts.error(survey)}")
    }

    @Test
    fun atTheEndAFitOfAllReadingsMayBeAskedFor() {
        val survey = Survey(grid, 5205)
        // The last fit of its own is of 609 readings, and is under way in the one that learns in parts.
        val atOnce = estimator(SelfCalibratingEstimator.AT_ONCE).take(survey, until = 650)
        val inParts = estimator(1.0).take(survey, until = 650)
        val before = atOnce.timeConstant
        for (one in listOf(atOnce, inParts)) one.learnFromAll()
        assertNotEquals(before, atOnce.timeConstant)
        val apart = abs(ln(inParts.timeConstant / atOnce.timeConstant))
        assertTrue(apart < 0.1 * atOnce.relativeUncertainty, "$apart")
        val after = atOnce.timeConstant
        atOnce.learnFromAll()
        assertEquals(after, atOnce.timeConstant, "nothing came since")
        // Not where readings came that are not kept.
        val short = estimator(SelfCalibratingEstimator.AT_ONCE, recalled = 300).take(survey, until = 650)
        val found = short.timeConstant
        short.learnFromAll()
        assertEquals(found, short.timeConstant)
    }

    @Test
    fun theKnownRangeIsThatOfTheCellsAndNotCutToThePrior() {
        val survey = Survey(grid, 5206)
        val narrow = Interval(0.2, 0.8)
        val estimator = SelfCalibratingEstimator(grid, narrow).take(survey)
        assertTrue(survey.truths.min() < narrow.lower && survey.truths.max() > narrow.upper)
        val known = checkNotNull(estimator.knownRange())
        assertEquals(survey.truths.min(), known.lower, 0.01)
        assertEquals(survey.truths.max(), known.upper, 0.01)
        assertNull(SelfCalibratingEstimator(grid, narrow).knownRange(), "before there is a reading")
    }

    @Test
    fun workMustBeAboveNothing() {
        for (work in listOf(0.0, -1.0, Double.NaN)) assertFailsWith<IllegalArgumentException> { estimator(work) }
    }
}
