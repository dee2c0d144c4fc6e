package stillwater.simulation

import stillwater.estimate.SensorBelief
import stillwater.field.FieldMap
import stillwater.mission.EstimatorName
import stillwater.mission.MissionState
import stillwater.wire.Malformed

/**
 * What became of the readings: each one that the board sent is under one heading.
 *
 * @property sent by the board. @property received by the mission: heard whole. @property logged under a verdict.
 * @property taken into the map. @property refused by reason, those that were refused. @property waiting for later ones.
 * @property inCells of those taken. @property outside of the map. @property rejected by the estimator.
 */
data class ReadingAccount(
    val sent: Long,
    val received: Long,
    val logged: Long,
    val taken: Long,
    val refused: Map<String, Long>,
    val waiting: Long,
    val inCells: Long,
    val outside: Long,
    val rejected: Long,
) {
    /** Lost or spoilt on the link. */
    val lost: Long get() = sent - received

    /** Whether nothing is missing: received is taken, refused and waiting, and all taken ones reached the map. */
    val isComplete: Boolean
        get() = received == logged && received == taken + refused.values.sum() + waiting &&
            taken == inCells + outside + rejected && received <= sent
}

/**
 * What a [MissionRun] came to.
 *
 * @property run that is over. @property film that was recorded of it. @property longest time that it was given, s.
 */
class SimulationResult(val run: MissionRun, val film: Film, val longest: Double) {
    private val cells = run.world.site.grid.size
    private val means = DoubleArray(cells) { run.world.meanTruth(it) }

    /** The mission's map. */
    val map: FieldMap = run.mission.map

    /** The same estimator with the same readings at the places where the boat really was. */
    val inProcess: FieldMap = InProcessMap.of(run.spec, run.track, run.readings.taken)

    /** The mean of each cell's readings, for comparison. */
    val averages: FieldMap =
        InProcessMap.of(run.spec.copy(estimator = EstimatorName.AVERAGING), run.track, run.readings.taken)

    /** Whether the mission came to its end in the time it was given. */
    val isOver: Boolean = run.mission.state is MissionState.Stopped

    /** The map against the water at the cells' centres. */
    val atCentres: MapErrors = MapErrors.of(map, truth = ::centre)

    /** The map against the water's mean over each cell. */
    val againstMeans: MapErrors = MapErrors.of(map, truth = ::mean)

    /** The map against the water at the centres, cells without readings included. */
    val overAllCells: MapErrors = MapErrors.of(map, { true }, ::centre)

    /** As [atCentres], of the map made in process, over the cells that both have readings of. */
    val inProcessError: MapErrors = MapErrors.of(inProcess, ::isInBoth, ::centre)

    /** As [atCentres], over the same cells as [inProcessError]. */
    val comparedError: MapErrors = MapErrors.of(map, ::isInBoth, ::centre)

    /** As [againstMeans], of the cells' averages. */
    val averagesError: MapErrors = MapErrors.of(averages, truth = ::mean)

    /** How the bounds hold the water at the centres. */
    val boundsAtCentres: BoundsHolding = BoundsHolding.of(map, ::centre)

    /** How the bounds hold the water's mean over each cell. */
    val boundsAroundMeans: BoundsHolding = BoundsHolding.of(map, ::mean)

    /** Where every reading went. */
    val readings: ReadingAccount = account()

    /** Lines that could not be read, by kind; only those that occurred. */
    val unreadable: Map<String, Long> = Malformed.entries
        .associate { it.name.lowercase().replace('_', '-') to run.mission.board.malformed(it) }
        .filterValues { it > 0 }

    /** What the estimator believes of the probe; null where it has no model of one. */
    val belief: SensorBelief? = run.mission.sensor

    /** Time between start and end of the way, s: all states in which the boat is under way. */
    val timeUnderWay: Double = run.history.spans
        .filter { it.state.isUnderWay }
        .sumOf { it.until - it.from }

    /** The true value at the centre of [cell], sensor units. */
    fun centre(cell: Int): Double = film.truths[cell]

    /** The true mean over [cell], sensor units. */
    fun mean(cell: Int): Double = means[cell]

    private fun isInBoth(cell: Int) = map.readings(cell) > 0 && inProcess.readings(cell) > 0

    private fun account(): ReadingAccount {
        val gate = run.mission.readings
        val log = run.readings
        return ReadingAccount(
            sent = run.world.boat.board.readings,
            received = gate.passed + gate.leftOut + gate.waiting,
            logged = log.logged,
            taken = log.taken.size.toLong(),
            refused = mapOf(
                "out-of-range" to gate.outOfRange,
                "lone" to gate.lone,
                "stuck" to gate.stuck,
                "without-value-or-place" to gate.withoutValueOrPlace,
            ).filterValues { it > 0 },
            waiting = gate.waiting.toLong(),
            inCells = (0 until cells).sumOf { map.readings(it).toLong() },
            // Estimators count a cell that was passed without a reading as a reading without a value.
            outside = map.outside,
            rejected = map.rejected - log.passes,
        )
    }
}
