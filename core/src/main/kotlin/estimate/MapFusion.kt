package stillwater.estimate

import stillwater.field.FieldMap
import kotlin.math.sqrt

/**
 * Makes one map of those of several boats, each from its own sensor's readings.
 *
 * Which way is right depends on what an estimator's bounds mean; core/docs/SeveralBoats.md gives the reasons. All maps
 * have one grid and one prior. Counts are summed. No call allocates.
 */
public fun interface MapFusion {
    /** Writes what [maps], at least one, tell together [into] a map of the same grid. Modified: all of its cells. */
    public fun fuse(maps: Array<FieldMap>, into: FieldMap)

    public companion object {
        /** For bounds that hold for certain: their intersection. The value is the midpoint. */
        public val INTERSECTION: MapFusion = MapFusion { maps, into ->
            each(maps, into) { cell ->
                var lower = maps[0].lower(cell)
                var upper = maps[0].upper(cell)
                for (map in maps) {
                    lower = maxOf(lower, map.lower(cell))
                    upper = minOf(upper, map.upper(cell))
                }
                into.setBounds(cell, lower, upper)
                into.setValue(cell, lower / 2 + upper / 2)
            }
        }

        /**
         * For credible intervals: values weighted by the inverse square of their intervals' half widths, and the interval
         * of that mean. A half width is the longer side of the value, as an end may be cut to the prior.
         */
        public val INVERSE_VARIANCE: MapFusion = MapFusion { maps, into ->
            each(maps, into) { cell -> pool(maps, into, cell) }
        }

        /** For means without bounds: the mean of all readings. */
        public val MEAN_OF_READINGS: MapFusion = MapFusion { maps, into ->
            each(maps, into) { cell -> average(maps, into, cell) }
        }

        private inline fun each(maps: Array<FieldMap>, into: FieldMap, fuse: (Int) -> Unit) {
            into.clearCounts()
            for (map in maps) into.addCounts(map)
            for (cell in 0 until into.grid.size) fuse(cell)
        }

        private fun average(maps: Array<FieldMap>, into: FieldMap, cell: Int) {
            var readings = 0L
            var mean = into.prior.midpoint
            for (map in maps) {
                if (map.readings(cell) == 0) continue
                readings += map.readings(cell)
                mean += (map.value(cell) - mean) * map.readings(cell) / readings
            }
            into.setBounds(cell, into.prior.lower, into.prior.upper)
            into.setValue(cell, mean)
        }

        private fun pool(maps: Array<FieldMap>, into: FieldMap, cell: Int) {
            val prior = into.prior
            var weights = 0.0
            var mean = prior.midpoint
            for (map in maps) {
                if (map.readings(cell) == 0 || isUnbounded(map, cell)) continue
                val half = maxOf(map.upper(cell) - map.value(cell), map.value(cell) - map.lower(cell))
                val weight = 1 / maxOf(half * half, LEAST_SQUARE)
                weights += weight
                mean += (map.value(cell) - mean) * weight / weights
            }
            if (weights == 0.0) {
                average(maps, into, cell)
                return
            }
            val half = 1 / sqrt(weights)
            into.setValue(cell, mean)
            // Each estimator cuts to the prior unless all of its interval lies beyond: so does their mean.
            val isBeyond = mean + half < prior.lower || mean - half > prior.upper
            val lower = if (isBeyond) mean - half else maxOf(prior.lower, mean - half)
            into.setBounds(cell, lower, if (isBeyond) mean + half else minOf(prior.upper, mean + half))
        }

        /** Whether [map] says no more of [cell] than the prior, as where its model does not explain the readings. */
        private fun isUnbounded(map: FieldMap, cell: Int) =
            map.lower(cell) <= map.prior.lower && map.upper(cell) >= map.prior.upper

        /** No interval is trusted to be narrower than its root. */
        private const val LEAST_SQUARE = 1e-24
    }
}
