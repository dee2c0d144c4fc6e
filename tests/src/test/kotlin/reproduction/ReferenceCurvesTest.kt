package stillwater.reproduction

import kotlinx.coroutines.runBlocking
import org.junit.jupiter.api.Assumptions.assumeTrue
import stillwater.run.Experiment
import stillwater.run.PlannerKind
import stillwater.run.Preset
import java.io.File
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.test.Test
import kotlin.test.assertTrue

/** The six curves of each field against an independent prototype's (its fields are other draws of the same kind). */
class ReferenceCurvesTest {
    @Test
    fun theSixCurvesOfEachFieldAgreeWithThePrototype() {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA is not set: the reference curves are not part of the repository")
        val settings = Preset.REPORT.settings().copy(checkpoints = MOVES, seed = SEED)
        val result = runBlocking { Experiment(settings).run(threads = 2) }
        val far = result.curves.flatMap { curve ->
            val reference = Reference(File(data, "reference_curves/${curve.field}.csv"))
            val column = "${PLANNERS.getValue(curve.planner)}_${curve.filter.label}"
            MOVES.mapNotNull { move ->
                val ours = curve.at(move)
                val difference = abs(ours.mean - reference[move, column])
                val standardError = hypot(ours.standardError, reference[move, "${column}_se"])
                "${curve.field} $column at move $move: $difference is ${difference / standardError} standard errors"
                    .takeIf { difference > BAR * standardError }
            }
        }
        assertTrue(far.isEmpty(), "seed $SEED: " + far.joinToString("\n"))
    }

    private class Reference(file: File) {
        private val header: List<String>
        private val rows: Map<String, List<String>>

        init {
            val lines = file.readLines().map { it.split(',') }
            header = lines.first()
            rows = lines.drop(1).associateBy { it.first() }
        }

        operator fun get(move: Int, column: String) = rows.getValue("$move")[header.indexOf(column)].toDouble()
    }

    private companion object {
        /** Not one of the seeds that the readings of the report were chosen with. */
        const val SEED = 20_261_120L

        /** The bar: 3 standard errors of the difference at each of 72 places. */
        const val BAR = 3.0
        val MOVES = listOf(50, 100, 200, 500, 1000, 2000)
        val PLANNERS = mapOf(
            PlannerKind.RANDOM_WALK to "walk",
            PlannerKind.LAWNMOWER to "lawn",
            PlannerKind.BOUNDED to "plan",
        )
    }
}
