package stillwater.benchmark

import stillwater.run.Curve
import stillwater.run.ExperimentResult
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import stillwater.run.TrialErrors

/** Builds an [ExperimentResult] from curves written down by hand, at moves 50, 100 and 200. */
internal class HandMadeResult(private val environments: Int = 2) {
    private val curves = ArrayList<Curve>()
    private val checkpoints = listOf(50, 100, 200)

    /** Adds a curve whose environments lie [SPREAD] below and above [means] in turn, a number for each checkpoint. */
    fun curve(
        planner: PlannerKind,
        filter: FilterKind,
        vararg means: Double,
        field: String = Preset.UNIFORM,
        boats: Int = 1,
    ) = apply {
        val errors = List(environments) { environment ->
            TrialErrors(means.size).apply {
                for (i in means.indices) {
                    mean[i] = means[i] + if (environments == 1) 0.0 else SPREAD * (2 * (environment % 2) - 1)
                    inExtremes[i] = mean[i] / 2
                    coverage[i] = if (environment % 2 == 0) 0.75 else 1.0
                    width[i] = 0.25
                }
            }
        }
        curves += Curve(field, filter, planner, checkpoints, errors, boats)
    }

    fun build(): ExperimentResult {
        val report = Preset.REPORT.settings()
        val fields = curves.map { it.field }.distinct()
        val settings = report.copy(
            fields = fields.associateWith { report.fields[it] ?: report.fields.getValue(Preset.UNIFORM) },
            filters = curves.map { it.filter }.distinct(),
            planners = curves.map { it.planner }.distinct(),
            environments = environments,
            moves = checkpoints.last(),
            checkpoints = checkpoints,
            boats = curves.map { it.boats }.distinct(),
        )
        return ExperimentResult(settings, curves, fields.associateWith { 0.4375 })
    }

    companion object {
        /** Half the distance between two environments: a power of two, so that their mean is exact. */
        const val SPREAD = 1.0 / 1024

        val WALK = PlannerKind.RANDOM_WALK
        val LAWNMOWER = PlannerKind.LAWNMOWER
        val PLANNER = PlannerKind.BOUNDED
        val BOUNDED = FilterKind.BOUNDED
        val AVERAGING = FilterKind.AVERAGING

        /** Both fields with all that the report's claims speak of, each of which holds. */
        fun likeTheReport(environments: Int = 2): ExperimentResult = HandMadeResult(environments).run {
            for ((field, averaging) in listOf(Preset.UNIFORM to 0.125, Preset.GAUSSIAN to 0.03125)) {
                curve(WALK, BOUNDED, 0.25, 0.125, 0.015625, field = field)
                curve(WALK, AVERAGING, 0.25, 0.1875, averaging, field = field)
                curve(LAWNMOWER, BOUNDED, 0.1875, 0.09375, 0.09375, field = field)
                curve(PLANNER, BOUNDED, 0.1875, 0.0625, 0.046875, field = field)
            }
            build()
        }
    }
}
