package stillwater.virtual

import stillwater.field.Field
import stillwater.model.Actuation
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.sensor.GaussianNoise
import stillwater.sensor.SensorModel
import stillwater.sensor.SensorSpec
import stillwater.wire.ByteLink
import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * How well a virtual boat's phone knows where it is.
 *
 * @property fixPeriod time between two fixes, s, above 0.
 * @property fixDeviation standard deviation of a fix's own error, each axis, m, at least 0.
 * @property wander standard deviation of the error that fixes share, each axis, m, at least 0.
 * @property wanderTime time constant with which that error changes, s, above 0.
 * @property compassDeviation standard deviation of a heading's own error, rad, at least 0.
 * @property compassOffset by which every heading is off, rad, counter-clockwise.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class PoseSpec(
    val fixPeriod: Double = 1.0,
    val fixDeviation: Double = 1.5,
    val wander: Double = 0.0,
    val wanderTime: Double = 60.0,
    val compassDeviation: Double = 0.02,
    val compassOffset: Double = 0.0,
) {
    init {
        require(fixPeriod > 0 && fixPeriod.isFinite()) { "fixPeriod ($fixPeriod s) must be above 0 and finite" }
        require(wanderTime > 0 && wanderTime.isFinite()) { "wanderTime ($wanderTime s) must be above 0 and finite" }
        for ((name, value) in listOf(
            "fixDeviation (m)" to fixDeviation,
            "wander (m)" to wander,
            "compassDeviation (rad)" to compassDeviation,
        )) {
            require(value >= 0 && value.isFinite()) { "$name ($value) must be at least 0 and finite" }
        }
        require(compassOffset.isFinite()) { "compassOffset ($compassOffset rad) must be finite" }
    }
}

/**
 * A whole virtual boat.
 *
 * @property sensor the probe, which is told the speed through the water ([VirtualBoat.CONDITIONS]).
 * @property hull boat and thrusters.
 * @property board electronics.
 * @property link between phone and board.
 * @property pose fixes and compass.
 * @property vectored whether it has a swivelled thruster in place of two fixed ones.
 * @property start where it lies at first.
 * @property heading at first, rad, counter-clockwise from east.
 * @property restsAt water in which the probe has come to rest before, sensor units, finite; null for the water at [start].
 */
public data class VirtualBoatSpec(
    val sensor: SensorSpec,
    val hull: Hull = Hull(),
    val board: BoardSpec = BoardSpec(),
    val link: LinkSpec = LinkSpec(),
    val pose: PoseSpec = PoseSpec(),
    val vectored: Boolean = false,
    val start: Position = Position(0.0, 0.0),
    val heading: Double = 0.0,
    val restsAt: Double? = null,
)

/**
 * A fix of the phone's receiver.
 *
 * @property time of the fix.
 * @property place where the receiver takes itself to be.
 */
public data class VirtualFix(val time: BoatTime, val place: LatLon)

/**
 * A boat on a desk: water, hull, probe, board and link, and the phone's receiver and compass, in virtual time.
 *
 * The phone has its end of the link ([phone]), its fixes ([takeFix]) and its compass ([heading]); what it must not know
 * is what [dynamics] tells. [advance] lets time pass. The same spec, field and seed give the same boat, byte for byte.
 * Confined to one thread.
 *
 * @property spec what it is made of.
 * @param field the water. Where it is not defined the probe keeps its last state and goes on to speak. Retained.
 * @param frame in which the field and the boat have their metres. Retained.
 * @param seed where all its noise comes from.
 */
public class VirtualBoat(
    public val spec: VirtualBoatSpec,
    private val field: Field,
    private val frame: LocalFrame,
    seed: Long,
) {
    private val random = Random(seed)

    /** Where the boat really is; its current and wind may be set. */
    public val dynamics: BoatDynamics = BoatDynamics(spec.hull, spec.start.x, spec.start.y, spec.heading)

    /** The link, which may be cut. */
    public val link: VirtualLink = VirtualLink(spec.link, Random(random.nextLong()))

    private val probe: SensorModel = probe()
    private val followsSpeed = Conditions.SPEED in spec.sensor.conditions
    private var reading = Double.NaN

    /** The electronics, which may be reset and whose battery may sag. */
    public val board: VirtualBoard = VirtualBoard(spec.board, spec.vectored, { _, _ -> reading }) {
        link.board.write(it.encodeToByteArray())
    }

    /**
     * Whether there is power for the motors. Without it they turn nothing, whatever the board tells them, and the boat
     * drifts; the board goes on and does not know.
     */
    public var hasMotorPower: Boolean = true

    private val fixNoise = GaussianNoise(spec.pose.fixDeviation, Random(random.nextLong()))
    private val wanderNoise = GaussianNoise(1.0, Random(random.nextLong()))
    private val compassNoise = GaussianNoise(spec.pose.compassDeviation, Random(random.nextLong()))
    private val inbound = ByteArray(VirtualLink.CAPACITY)
    private var ticks = 0L
    private var fixes = 0L
    private var owed = 0.0
    private var fix: VirtualFix? = null
    private var wanderX = spec.pose.wander * normal(wanderNoise)
    private var wanderY = spec.pose.wander * normal(wanderNoise)

    /** The virtual time: 0 at first. */
    public val time: BoatTime get() = BoatTime(ticks * TICK)

    /** The phone's end of the link. */
    public val phone: ByteLink get() = link.phone

    /** Yaw rate as a gyroscope has it, rad/s, counter-clockwise. */
    public val yawRate: Double get() = dynamics.yawRate

    /** The compass, rad, counter-clockwise from east; each question has an error of its own. */
    public fun heading(): Double =
        Math.IEEEremainder(dynamics.heading + spec.pose.compassOffset + normal(compassNoise), 2 * PI)

    /** The newest fix, once; null where there was none since it was last asked for. */
    public fun takeFix(): VirtualFix? = fix.also { fix = null }

    /** Lets [seconds] s pass, in ticks of [TICK]: what is less than one is kept for the next call. */
    public fun advance(seconds: Double) {
        if (!(seconds > 0 && seconds.isFinite())) return
        owed += seconds
        while (owed >= TICK - ROUNDING) {
            owed -= TICK
            tick()
        }
    }

    private fun tick() {
        ticks++
        dynamics.advance(TICK, if (hasMotorPower) board.actuation else REST)
        reading = probe.step(field.truth(dynamics.x, dynamics.y, time), TICK, conditions())
        link.advance(TICK)
        board.receive(inbound, 0, link.board.read(inbound))
        board.advance(TICK)
        if (time.seconds >= (fixes + 1) * spec.pose.fixPeriod - ROUNDING) locate()
    }

    /** Nothing is made anew for a probe that does not ask. */
    private fun conditions() =
        if (followsSpeed) Conditions(mapOf(Conditions.SPEED to dynamics.speedThroughWater)) else Conditions.NONE

    /** b ← b e^(−T/τ) + σ √(1 − e^(−2T/τ)) n: a first-order Gauss-Markov process. */
    private fun locate() {
        fixes++
        val kept = exp(-spec.pose.fixPeriod / spec.pose.wanderTime)
        val fresh = spec.pose.wander * sqrt(1 - kept * kept)
        wanderX = kept * wanderX + fresh * normal(wanderNoise)
        wanderY = kept * wanderY + fresh * normal(wanderNoise)
        val seen = Position(
            dynamics.x + wanderX + normal(fixNoise),
            dynamics.y + wanderY + normal(fixNoise),
        )
        fix = VirtualFix(time, frame.toLatLon(seen))
    }

    private fun normal(noise: GaussianNoise) = noise.step(0.0, TICK, Conditions.NONE)

    private fun probe(): SensorModel {
        val water = spec.restsAt ?: field.truth(spec.start.x, spec.start.y, BoatTime(0.0)).takeIf { it.isFinite() }
        return spec.sensor.build(water ?: 0.0, Random(random.nextLong()))
    }

    public companion object {
        /** Step of everything in it, s. */
        public const val TICK: Double = 0.02

        /** The conditions that its probe can follow; any other is unknown to it. */
        public val CONDITIONS: Set<String> = setOf(Conditions.SPEED)

        private const val ROUNDING = 1e-9

        /** No thrust and no torque, of a hull with either kind of thrusters. */
        private val REST = Actuation.Differential(0.0, 0.0)
    }
}
