package stillwater.wire

import stillwater.model.LatLon

/** What came of reading a sentence. */
internal sealed interface Sentence {
    /** It says [message]. */
    class Said(val message: Message) : Sentence

    /** It is sound, and of a kind that this program has no use for. */
    data object Unused : Sentence

    /** It cannot be read. */
    class Broken(val kind: Malformed) : Sentence
}

/**
 * Reads NMEA 0183 sentences: $--DBT depth, $--MTW water temperature, $--RMC and $--GGA fixes.
 *
 * A checksum is tested where there is one. Source: NMEA 0183, as the sonar and GPS receivers behind the board speak it.
 */
internal object Nmea {
    private const val KNOT = 1852.0 / 3600
    private const val LONGEST = 120

    /** Of $--RMC, since NMEA 2.3. */
    private const val MODE = 12

    /** Modes in which a receiver did not measure its place: estimated, manual, simulated, not valid. */
    private val NOT_FIXED = setOf("E", "M", "S", "N")

    /** Qualities that are fixes: GPS, differential, PPS, RTK fixed and float; some receivers say 9 with an augmentation. */
    private val QUALITIES = setOf("1", "2", "3", "4", "5", "9")

    /** No fix, and what is none: estimated (a receiver that goes on by dead reckoning), entered by hand, simulated. */
    private val NO_FIX = setOf("0", "6", "7", "8")
    private val UNUSED = setOf("GSA", "GSV", "VTG", "GLL", "GNS", "ZDA", "DPT", "VHW", "VLW", "HDG", "TXT")

    /** What the sentence in [bytes] from [start] until [end] says, heard on [port]. */
    fun read(port: Int, bytes: ByteArray, start: Int, end: Int): Sentence {
        if (end - start !in 6..LONGEST || bytes[start] != '$'.code.toByte()) return Sentence.Broken(Malformed.BAD_VALUE)
        val text = String(bytes, start + 1, end - start - 1, Charsets.ISO_8859_1).trimEnd()
        val star = text.indexOf('*')
        val body = if (star < 0) text else text.substring(0, star)
        if (star >= 0) {
            val sum = body.fold(0) { all, char -> all xor char.code }
            if (text.substring(star + 1).toIntOrNull(16) != sum) return Sentence.Broken(Malformed.CHECKSUM)
        }
        val fields = body.split(',')
        val message = when (fields[0].drop(2)) {
            "DBT" -> number(fields, 3)?.takeIf { it >= 0 }?.let { Message.Depth(port, it) }
            "MTW" -> number(fields, 1)?.let { Message.WaterTemperature(port, it) }
            "RMC" -> rmc(port, fields)
            "GGA" -> gga(port, fields)
            in UNUSED -> return Sentence.Unused
            else -> null
        }
        return message?.let { Sentence.Said(it) } ?: Sentence.Broken(Malformed.BAD_VALUE)
    }

    private fun rmc(port: Int, fields: List<String>): Message? {
        if (fields.size < 9) return null
        val seconds = secondsOfDay(fields[1]) ?: return null
        if (fields[2] == "V") return Message.Fix(port, seconds, null, Double.NaN, Double.NaN)
        if (fields[2] != "A") return null
        val place = if (fields.getOrNull(MODE) in NOT_FIXED) null else (place(fields, 3) ?: return null)
        val speed = number(fields, 7)?.let { it * KNOT } ?: Double.NaN
        return Message.Fix(port, seconds, place, speed, number(fields, 8) ?: Double.NaN)
    }

    private fun gga(port: Int, fields: List<String>): Message? {
        if (fields.size < 7) return null
        val seconds = secondsOfDay(fields[1]) ?: return null
        if (fields[6] in NO_FIX) return Message.Fix(port, seconds, null, Double.NaN, Double.NaN)
        if (fields[6] !in QUALITIES) return null
        return place(fields, 2)?.let { Message.Fix(port, seconds, it, Double.NaN, Double.NaN) }
    }

    /** ddmm.mmm, N or S, dddmm.mmm, E or W from field [first] on. */
    private fun place(fields: List<String>, first: Int): LatLon? {
        val latitude = degrees(fields[first], fields[first + 1], "N", "S")?.takeIf { it in LatLon.LATITUDES_DEG }
        val longitude = degrees(fields[first + 2], fields[first + 3], "E", "W")?.takeIf { it in -180.0..180.0 }
        return if (latitude != null && longitude != null) LatLon(latitude, longitude) else null
    }

    private fun degrees(text: String, side: String, plus: String, minus: String): Double? {
        val point = text.indexOf('.').let { if (it < 0) text.length else it }
        if (point < 4) return null
        val whole = text.substring(0, point - 2).toIntOrNull()?.takeIf { it >= 0 } ?: return null
        val minutes = finite(text.substring(point - 2))?.takeIf { it >= 0 && it < 60 } ?: return null
        return when (side) {
            plus -> whole + minutes / 60
            minus -> -(whole + minutes / 60)
            else -> null
        }
    }

    private fun secondsOfDay(text: String): Double? {
        if (text.length < 6) return null
        val hours = text.substring(0, 2).toIntOrNull()?.takeIf { it in 0..23 } ?: return null
        val minutes = text.substring(2, 4).toIntOrNull()?.takeIf { it in 0..59 } ?: return null
        val seconds = finite(text.substring(4))?.takeIf { it >= 0 && it < 61 } ?: return null
        return hours * 3600.0 + minutes * 60.0 + seconds
    }

    private fun number(fields: List<String>, index: Int): Double? = fields.getOrNull(index)?.let { finite(it) }

    private fun finite(text: String): Double? {
        val bytes = text.encodeToByteArray()
        return Decimal.parse(bytes, 0, bytes.size).takeIf { it.isFinite() }
    }
}
