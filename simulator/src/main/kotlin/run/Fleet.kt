package stillwater.run

import stillwater.estimate.MapFusion
import stillwater.field.CellField
import stillwater.field.FieldMap

/**
 * Any number of boats in one field that share one map: they all make a move, then the next.
 *
 * Each has estimators of its own, one of every kind under comparison; what they know is fused into one map a kind, which
 * is what is planned on and judged. A single boat's map is taken as it is.
 *
 * @property field the truth.
 * @property boats at least one; all with as many estimators, of the same kinds in the same order.
 * @property fusions how maps are fused, for each kind of estimator.
 * @property score how maps are judged.
 * @property sharing how the area is divided; null where every boat has all of it.
 * @property usesMap whether the planners read the map; where not, estimators are asked for theirs at checkpoints only.
 */
class Fleet(
    private val field: CellField,
    private val boats: List<Boat>,
    private val fusions: List<MapFusion>,
    private val score: MapScore,
    private val sharing: RegionSharing? = null,
    private val usesMap: Boolean = true,
) {
    private val kinds = boats.first().estimators.indices
    private val maps = kinds.map { kind -> Array(boats.size) { boats[it].estimators[kind].map } }
    private val shared = kinds.map { kind ->
        val first = maps[kind][0]
        if (boats.size == 1) first else FieldMap(first.grid, first.prior)
    }

    /**
     * Runs the boats. The planners plan on the shared map of the first kind of estimator.
     *
     * @param checkpoints moves after which the error is taken, ascending, each at least 1; the run ends with the last.
     * @return the errors of each kind of estimator, in their order.
     */
    fun run(checkpoints: IntArray): List<TrialErrors> {
        val errors = kinds.map { TrialErrors(checkpoints.size) }
        val map = if (usesMap || sharing != null) ({ map(0) }) else ({ shared[0] })
        var checkpoint = 0
        for (move in 1..checkpoints.last()) {
            sharing?.onMove(move, boats, map)
            for (boat in boats) if (!boat.isDone) boat.move(field, map)
            if (move == checkpoints[checkpoint]) {
                for (kind in kinds) score.take(map(kind), field, errors[kind], checkpoint)
                checkpoint++
            }
        }
        return errors
    }

    private fun map(kind: Int): FieldMap {
        // An estimator may bring its map up to date when it is asked for it.
        for (boat in boats) boat.estimators[kind].map
        if (boats.size > 1) fusions[kind].fuse(maps[kind], shared[kind])
        return shared[kind]
    }
}
