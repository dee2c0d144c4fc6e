package stillwater.world

import stillwater.field.Field
import stillwater.model.BoatTime
import stillwater.model.LocalFrame
import stillwater.sensor.SensorSpec
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin

/**
 * A virtual boat on its water: core's [VirtualBoat] with a drawn field, wind, a current that may turn, and a battery,
 * without which the boat has no thrust.
 *
 * Whoever plays the phone uses [boat]'s end of the link, its fixes and its compass, and lets time pass with [advance] only,
 * not with the boat's own. Deterministic, whatever the lengths of the steps. Confined to one thread.
 *
 * @property settings what it is made of. @property site where it lies.
 */
class VirtualWorld(val settings: WorldSettings, val site: WorldSite) {
    private val seeds = Seeds(settings.seed)

    /** The water. */
    val field: Field = settings.water.draw(
        site.grid,
        settings.waterRangeAt(site),
        Seeds(settings.waterSeed ?: settings.seed).random("water"),
    )

    /** The probe. */
    val sensor: SensorSpec = settings.sensorAt(site)

    /** The boat with its board and link. */
    val boat = VirtualBoat(
        VirtualBoatSpec(
            sensor,
            settings.hull,
            settings.board,
            settings.link,
            settings.pose,
            site.isVectored,
            site.start,
        ),
        field,
        LocalFrame(site.origin),
        seeds.random("boat").nextLong(),
    )

    /** What the motors have drawn. */
    val battery = Battery(settings.battery, settings.board.volts)

    /** When the battery was first empty; null while it is not. From then on the boat drifts. */
    var emptySince: BoatTime? = null
        private set
    private var owed = 0.0

    init {
        boat.dynamics.windX = settings.wind.east
        boat.dynamics.windY = settings.wind.north
        flow()
    }

    /** The virtual time: 0 at first. */
    val time: BoatTime get() = boat.time

    /** The truth in the cell with index [cell] of the site's grid at its centre, sensor units. */
    fun truthAtCentre(cell: Int): Double = field.truth(site.grid.centerX(cell), site.grid.centerY(cell), time)

    /** The mean of the truth over the cell with index [cell], from [SIDE] by [SIDE] points, sensor units. */
    fun meanTruth(cell: Int): Double {
        val grid = site.grid
        val c = cos(grid.rotation)
        val s = sin(grid.rotation)
        var sum = 0.0
        for (i in 0 until SIDE * SIDE) {
            val along = ((i % SIDE + MIDDLE) / SIDE - MIDDLE) * grid.cellWidth
            val across = ((i / SIDE + MIDDLE) / SIDE - MIDDLE) * grid.cellHeight
            val x = grid.centerX(cell) + c * along - s * across
            sum += field.truth(x, grid.centerY(cell) + s * along + c * across, time)
        }
        return sum / (SIDE * SIDE)
    }

    /** Lets [seconds] s pass, in ticks of [VirtualBoat.TICK]: what is less than one is kept for the next call. */
    fun advance(seconds: Double) {
        if (!(seconds > 0 && seconds.isFinite())) return
        owed += seconds
        while (owed >= VirtualBoat.TICK - ROUNDING) {
            owed -= VirtualBoat.TICK
            flow()
            boat.advance(VirtualBoat.TICK)
            battery.advance(VirtualBoat.TICK, boat.board.actuation)
            boat.board.volts = battery.volts
            if (battery.isEmpty && emptySince == null) {
                emptySince = time
                boat.hasMotorPower = false
            }
        }
    }

    private fun flow() {
        val angle = 2 * PI * time.seconds / settings.currentTurn
        val (east, north) = settings.current
        boat.dynamics.currentX = east * cos(angle) - north * sin(angle)
        boat.dynamics.currentY = east * sin(angle) + north * cos(angle)
    }

    private companion object {
        /** Points along a cell's side. */
        const val SIDE = 8
        const val MIDDLE = 0.5
        const val ROUNDING = 1e-9
    }
}
