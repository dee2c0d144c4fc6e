package stillwater.cli

import com.github.ajalt.clikt.core.GroupableOption
import com.github.ajalt.clikt.parameters.groups.ParameterGroup
import org.junit.jupiter.api.Test
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class OptionUsersTest {
    private val filters = OptionUser.filters(FilterKind.entries)
    private val planners = OptionUser.planners(PlannerKind.entries)

    /** A new option of a filter or planner has to say which, or it would be ignored beside the others. */
    @Test
    fun everyOptionOfFiltersAndPlannersSaysWhoUsesIt() {
        val tables = mapOf(
            BoundedFilterOptions::class to BoundedFilterOptions().users,
            LagFilterOptions::class to LagFilterOptions().users,
            PlannerOptions::class to PlannerOptions().users,
        )
        val options = BenchmarkCommand().registeredOptions().filterIsInstance<GroupableOption>()
        val checked = HashSet<String>()
        for (option in options) {
            val group: ParameterGroup = option.parameterGroup ?: continue
            val table = tables[group::class] ?: continue
            val names = option.names.filter { it in table.listed } + option.secondaryNames
            assertTrue(names.isNotEmpty(), "${option.names}")
            for (name in names) {
                val users = table.listed[name].orEmpty()
                assertTrue(users.isNotEmpty(), "$name has no users")
                assertTrue(users.all { it in filters + planners + OptionUser.option("--area") }, "$name: $users")
                checked += name
            }
        }
        // Epsilon is an option of the commands.
        assertEquals(tables.values.flatMap { it.listed.keys }.toSet() - "--epsilon", checked)
    }

    @Test
    fun whatNothingUsesIsRefusedAndWhatIsNotGivenIsNot() {
        val users = OptionUsers(mapOf("--a" to OptionUser.option("--b") + filters.take(2), "--c" to filters.take(1)))
        users.require(listOf("--a" to null, "--c" to false, "--free" to 1), emptyList())
        users.require(listOf("--a" to 1), OptionUser.option("--b"))
        users.require(listOf("--a" to 1, "--c" to true), filters.take(1))
        val found = listOf(
            emptyList<OptionUser>() to "none",
            filters.drop(2).take(2) + planners to "--filter bounded,interval",
        )
        for ((present, words) in found) {
            val refusal = assertFailsWith<BadFlag> { users.require(listOf("--a" to 0.0), present) }
            val expected = "--a: expected --b or --filter averaging or exponential to go with it, found $words"
            assertEquals(expected, refusal.message)
        }
    }

    @Test
    fun whatNobodyGaveIsCalledTheUsual() {
        val users = OptionUsers(mapOf("--a" to OptionUser.option("--b") + filters.take(1)))
        val present = filters.drop(2).take(1)
        val refusal = assertFailsWith<BadFlag> { users.require(listOf("--a" to 1), present, listOf("--filter")) }
        val expected = "--a: expected --b or --filter averaging to go with it, found the usual --filter bounded"
        assertEquals(expected, refusal.message)
    }
}
