package stillwater.model

/**
 * A place as a person types it: degrees with a point or a comma, north and east positive.
 *
 * @property latitudeDeg null where what was typed is no latitude that a survey can begin at.
 * @property longitudeDeg null where what was typed is no longitude.
 */
public class TypedPlace private constructor(public val latitudeDeg: Double?, public val longitudeDeg: Double?) {
    /** The place; null where one of the two is wrong. */
    public val place: LatLon?
        get() = if (latitudeDeg == null || longitudeDeg == null) null else LatLon(latitudeDeg, longitudeDeg)

    public companion object {
        private const val NUMERALS = "0123456789.+-"

        /** What [latitude] and [longitude] say; never throws. */
        public fun of(latitude: String, longitude: String): TypedPlace = TypedPlace(
            number(latitude)?.takeIf { it in LatLon.LATITUDES_DEG && LocalFrame.canStartAt(it) },
            number(longitude)?.takeIf { it in LatLon.LONGITUDES_DEG },
        )

        private fun number(text: String): Double? =
            text.trim().replace(',', '.').takeIf { it.all { sign -> sign in NUMERALS } }?.toDoubleOrNull()
    }
}
