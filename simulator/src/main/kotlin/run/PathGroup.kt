package stillwater.run

/** Filters that share a path, drawn from the stream of [leader]; a planner plans on the map of the first. */
internal class PathGroup(val leader: FilterKind, val filters: List<FilterKind>) {
    companion object {
        /**
         * Those of [planner] with all of [filters]. A planner that needs a map cannot plan on one without bounds: it then
         * plans on that of the bounded filter, which runs for it whether it is asked for or not.
         */
        fun of(planner: PlannerKind, filters: List<FilterKind>): List<PathGroup> {
            if (!planner.usesMap) return listOf(PathGroup(FilterKind.BOUNDED, filters))
            val (bounding, others) = filters.partition { it.givesBounds }
            val alone = (bounding - FilterKind.BOUNDED).map { PathGroup(it, listOf(it)) }
            if (others.isEmpty() && FilterKind.BOUNDED !in bounding) return alone
            return listOf(PathGroup(FilterKind.BOUNDED, listOf(FilterKind.BOUNDED) + others)) + alone
        }
    }
}
