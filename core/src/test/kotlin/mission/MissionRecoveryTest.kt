package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.wire.Message
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Readings that the map took, in the log's own order. */
internal fun Desk.replayedReadings(): List<Reading> = lines.flatMap { line ->
    val list = line.substringAfter("\"taken\":[[", "").substringBefore("]]")
    list.split("],").filter { it.isNotBlank() }.map { part ->
        val numbers = part.trim('[', ']').split(',').map { it.toDouble() }
        Reading(BoatTime(numbers[0]), Position(numbers[1], numbers[2]), numbers[3])
    }
}

class MissionRecoveryTest {
    private fun assertSame(expected: FieldMap, found: FieldMap) {
        for (cell in 0 until expected.grid.size) {
            assertEquals(expected.value(cell).toRawBits(), found.value(cell).toRawBits(), "value in $cell")
            assertEquals(expected.lower(cell).toRawBits(), found.lower(cell).toRawBits(), "lower bound in $cell")
            assertEquals(expected.upper(cell).toRawBits(), found.upper(cell).toRawBits(), "upper bound in $cell")
            assertEquals(expected.visits(cell), found.visits(cell), "visits to $cell")
            assertEquals(expected.readings(cell), found.readings(cell), "readings in $cell")
        }
        assertEquals(expected.outside, found.outside)
        assertEquals(expected.rejected, found.rejected)
    }

    private fun underWay(spec: MissionSpec, seed: Int, seconds: Double): Desk {
        val desk = Desk(spec, seed)
        desk.until(3.0) { false }
        desk.mission.start()
        desk.until(seconds) { false }
        return desk
    }

    @Test
    fun aLogGivesTheSameMapBitForBitWithEveryEstimator() {
        for (estimator in EstimatorName.entries) {
            val name = estimator.name.lowercase().replace('_', '-')
            val spec = MissionSpec.fromJson(Desk.SMALL.replace("self-calibrating", name))
            val desk = underWay(spec, 401, 300.0)
            val found = desk.replayed()
            assertSame(desk.mission.map, found.estimator.map)
            assertEquals(desk.mission.readings.passed, found.readings)
            assertEquals(desk.mission.used, found.used)
            assertEquals(0, found.unreadable)
            assertEquals("surveying", found.lastState)
        }
    }

    /** The process dies at any moment; the file has all but the end of the line that was being written. */
    @Test
    fun aMissionGoesOnFromALogThatWasCutDisarmed() {
        for (seed in 411..414) {
            val random = Random(seed)
            val desk = underWay(Desk.small(), seed, random.nextDouble(50.0, 300.0))
            val whole = desk.lines.dropLast(1)
            val cut = whole + desk.lines.last().let { it.take(random.nextInt(1, it.length)) }
            val recovery = Desk.replay(cut)
            val found = checkNotNull(recovery.recovered())
            assertEquals(1, found.unreadable)
            // The last line is the step's own, after what was read in it: no reading is lost.
            assertSame(desk.mission.map, found.estimator.map)
            val readings = found.readings

            val next = Desk(desk.spec, seed, recovered = found)
            assertEquals(MissionState.Idle, next.mission.state)
            next.until(5.0) { false }
            assertTrue(next.boat.board.actuation.isAtRest)
            next.mission.start()
            assertTrue(next.until(1000.0) { it is MissionState.Stopped }, "${next.mission.state}")
            assertEquals(MissionState.Stopped(StopReason.COMPLETED), next.mission.state)
            assertTrue(next.mission.used < 900.0)
            // Its clock began anew, and still each reading is later than the last before.
            val all = checkNotNull(Desk.replay(cut + next.lines).recovered())
            assertEquals(readings, next.mission.readingsBefore)
            assertEquals(readings + next.mission.readings.passed, all.readings)
            assertSame(next.mission.map, all.estimator.map)
        }
    }

    /** After a restart readings are of a time ahead of the steps', and so is one that waits. */
    @Test
    fun theLatestTimeOfALogIsThatOfAReadingThatWaitsWhereThatIsLater() {
        val lines = ArrayList<String>()
        val log = MissionLog(lines::add, LogStart(0, "a day"), Desk.small())
        val message = Message.Oxygen(1, 7.1)
        fun at(seconds: Double) = Reading(BoatTime(seconds), Position(1.0, 1.0), 7.1)
        log.reading(BoatTime(1.0), message, ReadingVerdict.HELD, emptyList(), at(500.0), emptyList())
        assertEquals(500.0, checkNotNull(Desk.replay(lines).recovered()).lastTime)
        log.reading(BoatTime(2.0), message, ReadingVerdict.SAME, emptyList(), null, listOf(at(501.0), at(502.0)))
        assertEquals(502.0, checkNotNull(Desk.replay(lines).recovered()).lastTime)
    }

    /** A probe that was stuck before the restart is stuck after it, not for the first time. */
    @Test
    fun howLongAProbeHasSaidTheSameIsNotForgotten() {
        val lines = ArrayList<String>()
        val log = MissionLog(lines::add, LogStart(0, "a day"), Desk.small())
        fun said(verdict: ReadingVerdict, run: Int) =
            log.reading(BoatTime(run.toDouble()), Message.Oxygen(1, 7.1), verdict, emptyList(), null, emptyList(), run)
        said(ReadingVerdict.SAME, 1)
        assertEquals(1, checkNotNull(Desk.replay(lines).recovered()).run)
        said(ReadingVerdict.STUCK, 7)
        assertEquals(7, checkNotNull(Desk.replay(lines).recovered()).run)
    }

    /** Nobody is to take what a virtual boat wrote for measured water, nor to go on with it on a real one. */
    @Test
    fun aLogSaysOfWhichBoatItIs() {
        val spec = Desk.small()
        val record = StepRecord(BoatTime(1.0), MissionState.Idle, null, Double.NaN, Drive.NONE, 0.0, 0)

        fun begun(boat: String?, isVirtual: Boolean?): List<String> =
            ArrayList<String>().also { MissionLog(it::add, LogStart(0, "a day", boat, isVirtual), spec).step(record) }

        val odd = "Boat \"3\"\n\u0001"
        val cases = listOf("Boat 3" to false, odd to true, null to null)
        for ((boat, isVirtual) in cases) {
            val found = checkNotNull(Desk.replay(begun(boat, isVirtual)).recovered())
            assertEquals(0, found.unreadable)
            assertEquals(boat to isVirtual, found.boat to found.isVirtual)
        }
        // It went on with another cable.
        val found = checkNotNull(Desk.replay(begun("Boat 3", false) + begun("USB serial", false)).recovered())
        assertEquals("USB serial" to false, found.boat to found.isVirtual)
    }

    @Test
    fun theWayAndWhatWasReadOnItAreToldInTheirOrder() {
        val desk = underWay(Desk.small(), 431, 120.0)
        val values = ArrayList<Double>()
        val places = ArrayList<Position>()
        val beliefs = ArrayList<Double>()
        val recovery = MissionRecovery(
            object : RecoveryListener {
                override fun took(reading: Reading, map: FieldMap) {
                    values += reading.value
                    beliefs += map.value(map.grid.cellAt(reading.position))
                }

                override fun at(place: Position) {
                    places += place
                }
            },
        )
        desk.lines.forEach(recovery::line)
        assertEquals(desk.replayedReadings().map { it.value }, values)
        assertTrue(values.size > 50 && beliefs.all { it.isFinite() })
        assertEquals(0, checkNotNull(recovery.recovered()).unreadable)
        // The last step's own place, and one for each step that knew it.
        val last = checkNotNull(desk.mission.position)
        assertEquals(0.0, places.last().distanceTo(last), 1e-3) // m; through UTM and back
        assertEquals(desk.lines.count { "\"pose\"" in it }, places.size)
        val bad = listOf(
            """{"pose":{},"mission":{"t_s":1.0,"state":"idle","used":0.0}}""",
            """{"pose":{"p":[1.0,2.0,0.0],"zone":"99North"},"mission":{"t_s":1.0,"state":"idle","used":0.0}}""",
            """{"pose":[1],"mission":{"t_s":1.0,"state":"idle","used":0.0}}""",
        )
        bad.forEach { recovery.line("1\tI\t$it") }
        assertEquals(bad.size.toLong(), checkNotNull(recovery.recovered()).unreadable)
    }

    @Test
    fun whatIsNoLogIsCounted() {
        val recovery = MissionRecovery()
        listOf(
            "",
            "garbage",
            "1\tI\t{",
            "1\tI\t[]",
            "1\tI\t{\"pass\":[1,2,3]}",
            "1\tI\t{\"spec\":{}}",
        ).forEach(recovery::line)
        assertNull(recovery.recovered())
        val desk = underWay(Desk.small(), 421, 10.0)
        val bad = listOf(
            "1\tI\t{\"pass\":[1,2]}",
            "1\tI\t{\"reading\":{\"taken\":[[1,2,3]]}}",
            "1\tI\t{\"reading\":{}}",
            "1\tI\t{\"mission\":{}}",
            "1\tI\t{\"spec\":{}}",
        )
        val found = checkNotNull(Desk.replay(desk.lines + bad).recovered())
        assertEquals(bad.size.toLong(), found.unreadable)
        assertSame(desk.mission.map, found.estimator.map)
    }
}
