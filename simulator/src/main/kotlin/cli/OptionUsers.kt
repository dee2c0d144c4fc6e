package stillwater.cli

import stillwater.run.FilterKind
import stillwater.run.PlannerKind

/** What may use another option: the option [option], or its [choice]; `--filter bounded`, `--area`. */
internal data class OptionUser(val option: String, val choice: String? = null) {
    companion object {
        /** The filters [kinds]. */
        fun filters(kinds: Collection<FilterKind>) = kinds.map { OptionUser("--filter", it.label) }

        /** The planners [kinds]. */
        fun planners(kinds: Collection<PlannerKind>) = kinds.map { OptionUser("--planner", it.label) }

        /** One option by its [name], whatever its value. */
        fun option(name: String) = listOf(OptionUser(name))
    }
}

/**
 * By option all that use it. An option that is not [listed] is always used.
 *
 * One that is given where nothing uses it is refused, for whoever gives it believes that it counts.
 */
internal class OptionUsers(val listed: Map<String, List<OptionUser>>) {
    /** These and [more], which lists other options. */
    operator fun plus(more: OptionUsers) = OptionUsers(listed + more.listed)

    /**
     * Refuses what nothing uses.
     *
     * @param given options with their values; null and false stand for one that was not given.
     * @param present what is there to use them.
     * @param defaults options of which [present] has the usual choice, for nobody gave them.
     * @throws BadFlag at the first that none of [present] uses.
     */
    fun require(
        given: List<Pair<String, Any?>>,
        present: Collection<OptionUser>,
        defaults: Collection<String> = emptyList(),
    ) {
        for ((flag, value) in given) {
            val users = listed[flag] ?: continue
            if (value == null || value == false || present.any { it in users }) continue
            val options = users.map { it.option }
            val found = text(present.filter { it.option in options }, ",", defaults)
            throw BadFlag(flag, "${text(users, " or ")} to go with it", found)
        }
    }

    /** The choices of one option stand behind it, between them [between]; `none` for nobody. */
    private fun text(users: List<OptionUser>, between: String, defaults: Collection<String> = emptyList()) =
        users.groupBy { it.option }.entries.joinToString(" or ") { (option, choices) ->
            val usual = if (option in defaults) "the usual" else ""
            listOf(usual, option, choices.mapNotNull { it.choice }.joinToString(between))
                .filter { it.isNotEmpty() }.joinToString(" ")
        }.ifEmpty { "none" }
}
