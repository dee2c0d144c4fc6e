package stillwater.io

import stillwater.model.Utm

/**
 * A UTM zone as Platypus logs write it: "17North", "56South".
 *
 * @property number 1 to 60.
 * @property north whether it is the northern half.
 */
internal data class UtmZone(val number: Int, val north: Boolean) {
    companion object {
        private val SHAPE = Regex("""(\d{1,2})(North|South)""")

        /** The zone written as [text], or null where there is no such zone. */
        fun parse(text: String): UtmZone? {
            val (number, half) = SHAPE.matchEntire(text)?.destructured ?: return null
            return number.toInt().takeIf { it in Utm.ZONES }?.let { UtmZone(it, half == "North") }
        }
    }
}
