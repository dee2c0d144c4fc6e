package stillwater.mission

import kotlinx.serialization.Serializable
import kotlinx.serialization.json.Json
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.sensor.slowestResponse
import kotlin.math.round

/**
 * A mission that a person is still filling in: anything may be missing or wrong, and [check] says what.
 *
 * Numbers are kept as they were typed, so that a half-typed one outlives a turn of the phone. Immutable; JSON by
 * [toJson].
 *
 * @property name what lists call it.
 * @property origin where the frame of all places has its zero; null before the first place.
 * @property isRectangle whether [shore] has two opposite corners of a rectangle, rather than the corners of a polygon.
 * @property shore corners in the order in which they were set.
 * @property keepOuts outlines within that are kept out of; the last may be unfinished.
 * @property home where the mission ends; null before it was set.
 * @property texts the numbers as typed; what was never touched is not in it.
 * @property quantity what the probe measures.
 * @property isTimed whether the budget is in seconds, rather than metres.
 * @property onBattery what to do when the boat's battery is low, or the phone's.
 * @property onFence what to do beyond the shore.
 * @property atEnd what to do when nothing is left to do.
 * @property rearms whether a board that disarmed itself is armed again without a person.
 * @property loaded the mission this began as; what the draft does not ask for stays as it is there. Null for a new one.
 */
@Serializable
public data class MissionDraft(
    val name: String = "",
    val origin: OriginSpec? = null,
    val isRectangle: Boolean = false,
    val shore: List<PlaceSpec> = emptyList(),
    val keepOuts: List<List<PlaceSpec>> = emptyList(),
    val home: PlaceSpec? = null,
    val texts: Map<DraftField, String> = emptyMap(),
    val quantity: Quantity = Quantity.DISSOLVED_OXYGEN,
    val estimator: EstimatorName = EstimatorName.BOUNDED_EXTENDED,
    val planner: PlannerName = PlannerName.POLYGON_RRT,
    val isTimed: Boolean = false,
    val onBattery: FailsafeSpec = FailsafeSpec.RETURN_HOME,
    val onFence: FailsafeSpec = FailsafeSpec.RETURN_HOME,
    val atEnd: FailsafeSpec = FailsafeSpec.RETURN_HOME,
    val rearms: Boolean = true,
    val loaded: MissionSpec? = null,
) {
    /** The text of [field], as typed or as it starts; drafts of before the phone's limit keep their mission's. */
    public fun text(field: DraftField): String = when (field) {
        DraftField.NAME -> name
        DraftField.LOWEST_PHONE -> texts[field] ?: loaded?.failsafe?.lowestPhonePercent?.let(::written)
        else -> texts[field]
    } ?: field.start.orEmpty()

    /** The number in [field] as typed, with a point where a comma was: what a program reads. */
    internal fun numeral(field: DraftField): String = text(field).trim().replace(',', '.')

    /** With [text] in [field]. */
    public fun with(field: DraftField, text: String): MissionDraft =
        if (field == DraftField.NAME) copy(name = text) else copy(texts = texts + (field to text))

    /** For [quantity], in the range that fresh water has of it; what was said in the units of another is forgotten. */
    public fun measuring(quantity: Quantity): MissionDraft {
        if (quantity == this.quantity) return this
        val (lowest, highest) = usual(quantity)
        val ofAnother =
            setOf(
                DraftField.LARGEST_JUMP,
                DraftField.STUCK_AFTER,
                DraftField.SMALLEST_SLOPE,
                DraftField.READING_ERROR,
            )
        return copy(quantity = quantity, texts = texts - ofAnother)
            .with(DraftField.LOWEST, lowest)
            .with(DraftField.HIGHEST, highest)
    }

    /** With the probe of [spec] in place of what was filled in of it. */
    public fun measuring(spec: ProbeSpec): MissionDraft = copy(
        quantity = spec.quantity,
        texts = texts + mapOf(
            DraftField.PORT to spec.port?.toString().orEmpty(),
            DraftField.LOWEST to written(spec.lowest),
            DraftField.HIGHEST to written(spec.highest),
            DraftField.LARGEST_JUMP to spec.largestJump?.let(::written).orEmpty(),
            DraftField.STUCK_AFTER to spec.stuckAfter?.toString().orEmpty(),
            DraftField.SMALLEST_SLOPE to spec.smallestSlope?.let(::written).orEmpty(),
            DraftField.READING_ERROR to spec.readingError?.let(::written).orEmpty(),
            DraftField.LATENCY to written(spec.latency),
            DraftField.SLOWEST to written(spec.longestTimeConstant),
        ),
    )

    /**
     * With the probe in [json] ([ProbeSpec]), or as slow as the sensor in it ([SensorSpec], as a diagnosis writes it).
     *
     * @throws IllegalArgumentException if it is neither; the message is one line that says what was expected.
     */
    public fun measuring(json: String): MissionDraft {
        if (!json.contains("\"stages\"")) return measuring(ProbeSpec.fromJson(json))
        val (low, high) = listOf(DraftField.LOWEST, DraftField.HIGHEST).map { numeral(it).toDoubleOrNull() ?: 0.0 }
        val seconds = SensorSpec.fromJson(json).slowestResponse(low, if (high > low) high else low + 1)
        return with(DraftField.SLOWEST, written(seconds))
    }

    /** Places are set from here on: an origin at [place], unless there is one. */
    public fun around(place: LatLon): MissionDraft =
        if (origin != null) this else copy(origin = OriginSpec(place.latitudeDeg, place.longitudeDeg))

    /** The frame of the places; null before there is an [origin]. */
    public fun frame(): LocalFrame? = origin?.let { LocalFrame(LatLon(it.latitude, it.longitude)) }

    /** What [position], m, is called in the mission: to the centimetre, which no fix is better than. */
    public fun place(position: Position): PlaceSpec = PlaceSpec(centimetres(position.x), centimetres(position.y))

    /** What is wrong with it, or the mission it has become. */
    public fun check(): DraftCheck = DraftChecker(this).check()

    /** The JSON form, on one line. */
    public fun toJson(): String = Json.encodeToString(serializer(), this)

    public companion object {
        /** Cells that a phone draws twice a second. */
        public const val MOST_CELLS: Int = 20_000

        /**
         * Checks that a phone can draw the map of [spec].
         *
         * @throws IllegalArgumentException if it has more than [MOST_CELLS] cells.
         */
        public fun requireDrawable(spec: MissionSpec): Unit =
            requireDrawable(spec.grid.columns.toDouble() * spec.grid.rows, spec.grid.cell)

        internal fun requireDrawable(cells: Double, size: Double) = require(cells <= MOST_CELLS) {
            "${cells.toLong()} cells of $size m are too many for a phone, which draws $MOST_CELLS; choose larger ones"
        }

        /** The draft whose [toJson] is [json]; a new one where it is something else, as another version's may be. */
        public fun fromJson(json: String): MissionDraft = try {
            Json.decodeFromString(serializer(), json)
        } catch (_: IllegalArgumentException) {
            // A SerializationException is one too.
            MissionDraft()
        }

        /** [spec] to go on from; unchanged it becomes [spec] again. */
        public fun of(spec: MissionSpec): MissionDraft = MissionDraft(
            name = spec.name,
            origin = spec.origin,
            isRectangle = spec.area.shore == null,
            shore = spec.area.shore ?: listOfNotNull(spec.area.southWest, spec.area.northEast),
            keepOuts = spec.area.keepOuts,
            home = spec.home,
            texts = mapOf(
                DraftField.CELL to written(spec.grid.cell),
                DraftField.BUDGET to written(spec.budget.metres ?: spec.budget.seconds ?: 0.0),
                DraftField.RESERVE to written(spec.budget.reserve),
                DraftField.TOP_SPEED to written(spec.boat.topSpeed),
                DraftField.CRUISE to written(spec.boat.cruise),
                DraftField.ARRIVAL to written(spec.boat.arrival),
                DraftField.LOWEST_VOLTS to spec.failsafe.lowestVolts?.let(::written).orEmpty(),
                DraftField.LOWEST_PHONE to written(spec.failsafe.lowestPhonePercent),
            ),
            estimator = spec.estimator,
            planner = spec.planner,
            isTimed = spec.budget.seconds != null,
            onBattery = spec.failsafe.battery,
            onFence = spec.failsafe.fence,
            atEnd = spec.failsafe.end,
            rearms = spec.failsafe.rearms,
            loaded = spec,
        ).measuring(spec.probe)

        private fun written(number: Double) = number.toString().removeSuffix(".0")

        private fun centimetres(metres: Double) = round(metres * 100) / 100

        /** Least and greatest value that fresh water has, with room: what lies beyond is the probe's fault. */
        private fun usual(quantity: Quantity) = when (quantity) {
            Quantity.DISSOLVED_OXYGEN -> "0" to "20"
            Quantity.ACIDITY -> "4" to "11"
            Quantity.CONDUCTIVITY -> "0" to "2000"
            Quantity.TEMPERATURE -> "-1" to "40"
            Quantity.DEPTH -> "0" to "100"
        }
    }
}
