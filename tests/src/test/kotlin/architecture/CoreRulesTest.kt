package stillwater.architecture

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Core's first rule: what it depends on, and which way its arrows run. */
class CoreRulesTest {
    @Test
    fun coreKeepsItsRules() {
        val sources = KotlinSource.of("core", "main")
        assertTrue(sources.isNotEmpty(), "no sources read from ${Repository.root}")
        val found = sources.flatMap(::coreViolations)
        assertTrue(found.isEmpty(), found.joinToString("\n", prefix = "Against core's rules:\n"))
    }

    @Test
    fun aForbiddenArrowIsFound() {
        assertEquals(
            listOf(Violation("core/X.kt", 3, "model may not use plan")),
            violations("model", "val x = 1", "import stillwater.plan.Planner"),
        )
        assertEquals(listOf("plan may not use estimate"), whats("plan", "val f = stillwater.estimate.BoundedFilter()"))
        assertEquals(listOf("mission may not use virtual"), whats("mission", "import stillwater.virtual.*"))
        assertEquals(listOf("sensor may not use field"), whats("sensor", "import stillwater.field.Field as Truth"))
        assertEquals(1, whats("helpers", "val x = 1").size, "a package the rules do not know")
    }

    @Test
    fun aForbiddenArrowWithinDiagnoseIsFound() {
        val blind = "import stillwater.diagnose.blind.BlindFit"
        assertEquals(listOf("evidence may not use blind"), whats("diagnose/evidence", blind))
        assertEquals(listOf("reference may not use blind"), whats("diagnose/reference", blind))
        assertEquals(1, whats("diagnose/helpers", "val x = 1").size, "a package the rules do not know")
        val below = "import stillwater.diagnose.algebra.dot"
        assertTrue(whats("diagnose/blind", below, blind, "import stillwater.diagnose.Cause").isEmpty())
        assertEquals(listOf("diagnose may not use blind"), whats("diagnose", blind))
        assertTrue(whats("diagnose", below).isEmpty())
    }

    @Test
    fun arrowsReachThroughWhatTheyPointTo() {
        assertEquals(setOf("model"), reachable("model"))
        assertEquals(setOf("plan", "field", "model"), reachable("plan"))
        assertEquals(setOf("diagnose", "sensor", "estimate", "field", "model"), reachable("diagnose"))
        assertTrue(reachable("mission").orEmpty().none { it == "virtual" || it == "diagnose" })
        assertTrue(whats("estimate", "import stillwater.model.Grid", "import stillwater.sensor.SensorModel").isEmpty())
    }

    @Test
    fun theOutsideWorldIsFound() {
        listOf(
            "import java.io.File",
            "import java.time.Instant",
            "import android.util.Log",
            "import kotlinx.coroutines.delay",
            "import java.util.concurrent.locks.Lock",
            "val text = java.nio.file.Path.of(name)",
            "val worker = Thread { }",
            "val now = System.currentTimeMillis()",
            "val now = System.nanoTime()",
            "val start = TimeSource.Monotonic.markNow()",
            "val random = Random.Default",
            "val x = Random.nextDouble()",
            "val x = Math.random()",
            "val cell = cells.random()",
            "val order = cells.shuffled()",
            "println(cells)",
        ).forEach { assertTrue(whats("model", it).isNotEmpty(), "not found: $it") }
    }

    @Test
    fun whatIsAllowedIsLetThrough() {
        val allowed =
            whats(
                "sensor",
                "import kotlin.math.exp",
                "import kotlin.random.Random",
                "import kotlinx.serialization.Serializable",
                "import org.hipparchus.stat.regression.SimpleRegression",
                "import java.util.PriorityQueue",
                "import stillwater.model.Position",
                "// Thread, System.nanoTime() and java.io.File in a comment",
                "/** @sample stillwater.plan.X */",
                "val text = \"System.nanoTime() and stillwater.plan in a string\"",
                "val x = random.nextDouble() + cells.random(random)",
                "val y = builder.print(x)",
            )
        assertEquals(emptyList(), allowed)
    }

    private fun whats(corePackage: String, vararg lines: String): List<String> =
        violations(corePackage, *lines).map { it.what }

    private fun violations(corePackage: String, vararg lines: String): List<Violation> {
        val text = "package stillwater.$corePackage\n" + lines.joinToString("\n")
        return coreViolations(KotlinSource("core/X.kt", corePackage, text))
    }
}
