package stillwater.mission

import stillwater.estimate.FieldEstimator
import stillwater.estimate.update
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.wire.Message

/** Hears what a [Survey] does with each reading, for the log. */
internal interface SurveyListener {
    /** [message] came from the probe; [verdict] of [gate] became of it, and [taken] went into the map, in order. */
    fun read(message: Message, verdict: ReadingVerdict, taken: List<Reading>, gate: PlausibilityGate)

    /** The boat left a cell in which no reading was taken; it was at [place] at [time]. */
    fun passed(time: BoatTime, place: Position)
}

/**
 * From the probe's messages to the map: where and when each reading was sampled, whether it is plausible, and which cells
 * were passed without one. Confined to one thread.
 *
 * @property estimator makes the map. Retained.
 */
internal class Survey(
    private val probe: ProbeSpec,
    val estimator: FieldEstimator,
    private val listener: SurveyListener,
) {
    private val history = PoseHistory()
    private val taken = ArrayList<Reading>()
    private var shift = 0.0
    private var watched: Int = NOWHERE
    private var hasReading = false
    private var watchedTime = BoatTime(0.0)
    private var watchedPlace = Position(0.0, 0.0)

    val gate = PlausibilityGate(
        probe.range,
        probe.largestJump ?: (probe.range.width * DEFAULT_JUMP),
        probe.stuckAfter,
        ::accept,
    )

    val map: FieldMap get() = estimator.map

    /** Whether the boat's place is in doubt now. */
    var isDoubted = false

    /** Readings that were taken while it was. */
    var doubted = 0L
        private set

    /** What the probe last said that was taken, sensor units; NaN before. */
    var lastValue = Double.NaN
        private set

    /** Goes on from [recovered] at [now]: the boat's clock may have begun anew. */
    fun resume(recovered: RecoveredMission, now: BoatTime) {
        shift = maxOf(0.0, recovered.lastTime + AFTER - now.seconds)
        lastValue = recovered.lastValue
        gate.resume(recovered.lastValue, recovered.held, recovered.same, recovered.run)
    }

    /** The boat is at ([x], [y]), m, [now], known to [deviation], m. */
    fun pose(now: BoatTime, x: Double, y: Double, deviation: Double) {
        if (!history.add(now, x, y, deviation)) return
        val sampled = now + -probe.latency
        val place = history.at(sampled) ?: return
        val cell = map.grid.cellAt(place)
        if (cell != watched) {
            if (watched != NOWHERE && !hasReading) pass()
            watched = cell
            hasReading = false
        }
        watchedTime = sampled + shift
        watchedPlace = place
    }

    /** Takes [message], heard at [now]. Answers whether it was the probe's. */
    fun take(message: Message, now: BoatTime): Boolean {
        val value = valueOf(message)
        if (value.isNaN()) return false
        val sampled = now + -probe.latency
        val place = history.at(sampled)
        taken.clear()
        val verdict = if (place == null) {
            gate.lacksPlace()
        } else {
            val known = Conditions(mapOf(Conditions.POSITION_DEVIATION to history.deviationAt(sampled)))
            gate.take(Reading(sampled + shift, place, value, known))
        }
        listener.read(message, verdict, taken, gate)
        return true
    }

    private fun accept(reading: Reading) {
        estimator.update(reading)
        if (isDoubted) doubted++
        lastValue = reading.value
        if (map.grid.cellAt(reading.position) == watched) hasReading = true
        taken.add(reading)
    }

    private fun pass() {
        gate.giveUp()
        estimator.update(watchedTime, watchedPlace.x, watchedPlace.y, Double.NaN)
        listener.passed(watchedTime, watchedPlace)
    }

    /** What [message] says of the probe's quantity; NaN where it is of something else. */
    private fun valueOf(message: Message): Double = when (message) {
        is Message.Oxygen -> of(message.port, Quantity.DISSOLVED_OXYGEN, message.milligramsPerLitre)
        is Message.Acidity -> of(message.port, Quantity.ACIDITY, message.ph)
        is Message.Depth -> of(message.port, Quantity.DEPTH, message.metres)
        is Message.WaterTemperature -> of(message.port, Quantity.TEMPERATURE, message.celsius)
        is Message.Conductivity -> if (probe.quantity == Quantity.TEMPERATURE) {
            of(message.port, Quantity.TEMPERATURE, message.celsius)
        } else {
            of(message.port, Quantity.CONDUCTIVITY, message.microsiemensPerCm)
        }
        else -> Double.NaN
    }

    private fun of(port: Int, quantity: Quantity, value: Double) =
        if (quantity == probe.quantity && (probe.port == null || probe.port == port)) value else Double.NaN

    private companion object {
        /** No cell and not outside either: the boat's place was never known. */
        const val NOWHERE = Grid.OUTSIDE - 1

        /** Share of the range that a reading may jump where the mission says nothing. */
        const val DEFAULT_JUMP = 0.2

        /** By which the first reading after a restart is later than the last before it at least, s. */
        const val AFTER = 1e-3
    }
}
