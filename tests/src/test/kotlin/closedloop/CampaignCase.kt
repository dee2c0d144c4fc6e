package stillwater.closedloop

import stillwater.control.Mixing
import stillwater.field.Field
import stillwater.mission.EstimatorName
import stillwater.mission.MissionSpec
import stillwater.mission.PlannerName
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.virtual.LinkSpec
import stillwater.virtual.PoseSpec
import stillwater.virtual.VirtualBoatSpec
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.roundToInt
import kotlin.math.sin
import kotlin.random.Random

/**
 * One run's mission, boat, water and weather, drawn from [seed].
 *
 * Each cell's water has one value, so that what a cell's bounds should hold is not in doubt.
 */
internal class CampaignCase(val seed: Long) {
    private val random = Random(seed)
    private val columns = random.nextInt(4, 7)
    private val cell = random.nextInt(7, 11)
    private val wide = columns * cell

    /** One board in five is of firmware v4.2.0 as it is, which waits 3 s for a command; the others are quicker. */
    val watchdog = if (random.nextInt(5) == 0) 3.0 else 0.5
    val mixing: Mixing = if (random.nextBoolean()) Mixing.DIFFERENTIAL else Mixing.VECTORED
    private val planner = PlannerName.entries.random(random)
    private val estimator = EstimatorName.entries.random(random)

    val spec: MissionSpec = MissionSpec.fromJson(json())
    private val levels = DoubleArray(columns * columns) { random.nextDouble(6.0, 9.0) }
    private val currentSpeed = random.nextDouble(0.0, 0.3)
    private val currentTurn = random.nextDouble(-1.0, 1.0) * 2 * PI / 600
    private val currentAngle = random.nextDouble(2 * PI)
    private val windSpeed = random.nextDouble(0.0, 5.0)
    private val windAngle = random.nextDouble(2 * PI)

    /** What the water of the cell is, outside of the grid that of the nearest. */
    fun truth(cell: Int): Double = levels[cell]

    val field = Field { x, y, _ -> levels[place(y) * columns + place(x)] }

    val boat = VirtualBoatSpec(
        SensorSpec.fromJson(
            """{"name":"probe","stages":[""" +
                """{"type":"first-order-lag","time_constant_s":${random.nextDouble(2.0, 10.0)}},""" +
                """{"type":"noise","standard_deviation":0.02}]}""",
        ),
        board = board(random.nextDouble(2.0, 6.0)),
        link = LinkSpec(delay = random.nextDouble(0.0, 0.05)),
        pose = PoseSpec(compassOffset = random.nextDouble(-0.05, 0.05)),
        vectored = mixing == Mixing.VECTORED,
        start = spec.home.let { Position(it.x, it.y) },
        heading = random.nextDouble(-PI, PI),
    )

    /** Of the quick ones one in two is of the master branch, drawn from the seed apart so that the rest stays as it was. */
    private fun board(arming: Double): BoardSpec {
        val other = Random(seed * 31 + 11)
        val firmware = if (watchdog < Firmware.V4_2.watchdog && other.nextBoolean()) Firmware.MASTER else Firmware.V4_2
        return BoardSpec(
            firmware,
            watchdog,
            arming = arming,
            oxygenPeriod = 1.0,
            batteryPeriod = other.nextDouble(1.0, 5.0),
        )
    }

    fun currentX(seconds: Double) = currentSpeed * cos(currentAngle + currentTurn * seconds)

    fun currentY(seconds: Double) = currentSpeed * sin(currentAngle + currentTurn * seconds)

    val windX get() = windSpeed * cos(windAngle)

    val windY get() = windSpeed * sin(windAngle)

    private fun place(metres: Double) = (metres / cell).toInt().coerceIn(0, columns - 1)

    private fun json(): String {
        val room = random.nextInt(10, 16)
        val far = wide + room
        // Corners cut off, and for planners that find their way a keep-out within the grid, else one beside it.
        val shore = corners(
            listOf(-room to 0, 0 to -room, wide to -room, far to 0, far to wide, wide to far, 0 to far, -room to wide),
        )
        val from = if (planner.keepsToWater) wide / 2 else wide + room / 2
        val size = if (planner.keepsToWater) cell else room
        val keepOut = corners(
            listOf(from to from / 2, from + size to from / 2, from + size to from / 2 + size, from to from / 2 + size),
        )
        val area = if (random.nextInt(3) > 0 || planner.keepsToWater) {
            """{"shore":$shore,"keep_outs":[$keepOut]}"""
        } else {
            """{"south_west":{"x_m":${-room},"y_m":${-room}},"north_east":{"x_m":$far,"y_m":$far}}"""
        }
        val seconds = random.nextInt(150, 400)
        val metres = (seconds * 0.8).roundToInt()
        val budget = if (random.nextBoolean()) """{"seconds":$seconds}""" else """{"metres":$metres}"""
        val half = cell / 2.0
        return """{"name":"run-$seed","origin":{"lat_deg":45.5,"lon_deg":-73.6},"area":$area,""" +
            """"grid":{"south_west":{"x_m":0,"y_m":0},"columns":$columns,"rows":$columns,"cell_m":$cell},""" +
            """"probe":{"quantity":"dissolved-oxygen","port":1,"lowest":4,"highest":12,""" +
            """"largest_jump":0.1,"stuck_after":6,""" +
            """"longest_time_constant_s":12},"estimator":"${word(estimator)}","planner":"${word(planner)}",""" +
            """"budget":$budget,"home":{"x_m":$half,"y_m":$half},"seed":$seed,""" +
            """"boat":{"mixing":"${mixing.name.lowercase()}"},""" +
            """"failsafe":{"lowest_volts":12,"battery":"${policy()}","fence":"${policy()}","end":"${policy()}"}}"""
    }

    /** Mostly home, as boats are set up. */
    private fun policy() = when (random.nextInt(5)) {
        0 -> "hold"
        1 -> "stop"
        else -> "return-home"
    }

    private fun word(name: Enum<*>) = name.name.lowercase().replace('_', '-')

    private fun corners(places: List<Pair<Int, Int>>) =
        places.joinToString(",", "[", "]") { (x, y) -> """{"x_m":$x,"y_m":$y}""" }
}
