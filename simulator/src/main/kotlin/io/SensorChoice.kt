package stillwater.io

/**
 * Which number of which sensor of a Platypus log to take, written `TYPE[#CHANNEL][.FIELD]`.
 *
 * @property type sensor type as in the log, upper case.
 * @property channel channel of the board, or null for the only one that has this type.
 * @property field index into the sensor's data.
 */
internal data class SensorChoice(val type: String, val channel: Int?, val field: Int) {
    override fun toString(): String {
        val names = FIELDS[type]
        val suffix = names?.getOrNull(field) ?: field.toString().takeIf { field > 0 }
        return type + (channel?.let { "#$it" } ?: "") + (suffix?.let { ".$it" } ?: "")
    }

    companion object {
        /** Names of the numbers of sensors that give several. */
        val FIELDS: Map<String, List<String>> = mapOf(
            "ES2" to listOf("ec", "temp"),
            "BATTERY" to listOf("voltage", "1", "2"),
        )

        private val SHAPE = Regex("""([A-Za-z0-9_]+)(?:#(\d+))?(?:\.(\w+))?""")

        /** What [text] means, or null where it is not written as it should be. */
        fun parse(text: String): SensorChoice? {
            val (type, channel, field) = SHAPE.matchEntire(text.trim())?.destructured ?: return null
            val names = FIELDS[type.uppercase()].orEmpty()
            val index = when {
                field.isNotEmpty() -> field.toIntOrNull() ?: names.indexOf(field.lowercase())
                names.isEmpty() -> 0
                else -> -1
            }
            return if (index < 0) null else SensorChoice(type.uppercase(), channel.toIntOrNull(), index)
        }
    }
}
