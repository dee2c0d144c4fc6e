package stillwater.diagnose.blind

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** A sensor that is given, on a log without a reference. */
class GivenLagTest {
    private val rows = 900
    private val track = CrossingTrack(rows + 3)

    /** A lag of 5 s that shows the water [late] seconds late. */
    private fun log(late: Int): MeasuredSeries {
        val random = java.util.Random(9)
        val shown = track.shown(5.0)
        val values = DoubleArray(rows) { shown[it] + 0.004 * random.nextGaussian() }
        fun DoubleArray.after() = copyOfRange(late, late + rows)
        return MeasuredSeries(track.times.copyOf(rows), track.x.after(), track.y.after(), values, null)
    }

    private fun diagnosed(vararg stages: SensorStage, late: Int = 3) =
        Diagnosis(log(late), DiagnosisSettings(base = SensorSpec("given", stages.toList()))).run()

    @Test
    fun aDeadTimeThatIsGivenIsNoCause() {
        val result = diagnosed(SensorStage.Delay(3.0), SensorStage.Lag(5.0))
        val causes = (result.verdict as? Verdict.Ambiguous)?.sets ?: listOf(emptyList())
        // On so short a way a lag and a dead time may be either.
        val isLag = causes == listOf(listOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME))
        assertTrue(isLag || result.verdict == Verdict.Consistent, "${result.verdict}")
        assertTrue(result.warnings.any { "3.00 s, was taken as right" in it }, "${result.warnings}")
        assertTrue(result.warnings.none { "time constant alone" in it }, "${result.warnings}")
    }

    @Test
    fun aTimeConstantBesideADeadBandIsNotBlamedForThat() {
        val result = diagnosed(SensorStage.Lag(2.0), SensorStage.Backlash(0.3), late = 0)
        assertTrue(result.warnings.any { "The sensor given was not used" in it }, "${result.warnings}")
        assertTrue(result.candidates.none { it.cause == Cause.TIME_CONSTANT }, "${result.verdict}")
        assertTrue(result.verdict.ambiguity.isNotEmpty() || result.verdict == Verdict.Consistent, "${result.verdict}")
    }

    @Test
    @Tag("long")
    fun aWrongTimeConstantBesideItIsNamedAndTheDeadTimeStays() {
        val result = diagnosed(SensorStage.Delay(3.0), SensorStage.Lag(9.0))
        val named = when (val verdict = result.verdict) {
            is Verdict.Named -> verdict.causes
            else -> assertIs<Verdict.Ambiguous>(verdict).sets.flatten()
        }
        assertTrue(Cause.TIME_CONSTANT in named, "${result.verdict}")
        val stages = assertNotNull(result.extendedSensor).stages
        assertEquals(5.0, assertIs<SensorStage.Lag>(stages.first { it is SensorStage.Lag }).timeConstant, 0.2)
        assertEquals(3.0, assertIs<SensorStage.Delay>(stages.first()).deadTime, 0.2)
    }

    @Test
    fun aDeadTimeThatIsTooLongIsNamed() {
        val result = diagnosed(SensorStage.Delay(4.0), SensorStage.Lag(5.0), late = 0)
        val causes = (result.verdict as? Verdict.Named)?.causes ?: result.verdict.ambiguity.flatten()
        assertTrue(Cause.DEAD_TIME in causes, "${result.verdict}")
        assertTrue(result.warnings.any { "4.00 s, is too long" in it }, "${result.warnings}")
        val dead = result.candidates.first { it.cause == Cause.DEAD_TIME }.parameters
        assertTrue(dead.single { it.name == "dead_time_s" }.value < 1.0, "$dead")
        val stages = assertNotNull(result.extendedSensor).stages
        assertEquals(5.0, assertIs<SensorStage.Lag>(stages.first { it is SensorStage.Lag }).timeConstant, 0.5)
    }

    @Test
    @Tag("long")
    fun ofOneThatIsTooShortTheWholeIsToldAndTheLagIsNoLonger() {
        val result = diagnosed(SensorStage.Delay(1.0), SensorStage.Lag(5.0))
        val named = (result.verdict as? Verdict.Named)?.causes.orEmpty()
        val sets = (result.verdict as? Verdict.Ambiguous)?.sets.orEmpty()
        assertTrue(named == listOf(Cause.DEAD_TIME) || sets.any { Cause.DEAD_TIME in it }, "${result.verdict}")
        assertTrue(listOf(Cause.TIME_CONSTANT) !in sets, "${result.verdict}")
        val dead = result.candidates.first { it.cause == Cause.DEAD_TIME }.parameters
        assertEquals(3.0, dead.single { it.name == "dead_time_s" }.value, 0.5)
    }

    @Test
    fun placesBeforeAreOnALineBetweenRows() {
        val times = doubleArrayOf(0.0, 1.0, 3.0, 4.0)
        val places = doubleArrayOf(0.0, 10.0, 30.0, 20.0)
        val earlier = MeasuredSeries(times, places, places, times, null).atPlacesBefore(0.5)
        assertContentEquals(doubleArrayOf(0.0, 5.0, 25.0, 25.0), earlier.x)
        assertContentEquals(earlier.x, earlier.y)
    }
}
