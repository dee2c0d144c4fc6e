package stillwater.io

import kotlinx.serialization.ExperimentalSerializationApi
import kotlinx.serialization.descriptors.PrimitiveKind
import kotlinx.serialization.descriptors.SerialDescriptor
import kotlinx.serialization.descriptors.SerialKind
import kotlinx.serialization.descriptors.StructureKind
import kotlinx.serialization.descriptors.elementNames
import stillwater.mission.MissionSpec
import java.io.IOException
import java.nio.charset.CharacterCodingException
import java.nio.file.AccessDeniedException
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path

/** A mission that cannot be used: one line that names the file, the line, the column, the field and what was expected. */
class MissionProblem(message: String, cause: Throwable? = null) : Exception(message, cause)

/** Reads the file of a mission. */
object MissionFile {
    private const val LONGEST = 10_000_000
    private val PATH = Regex("""at path:? (\$\S*)""")
    private val OFFSET = Regex("""at offset (\d+)""")
    private val RULE = Regex("""because of '(.*)' exception in the decoder""")
    private val MISSING = Regex("""Fields? (?:'([^']+)' is|\[([^]]+)] are) required""")
    private val UNKNOWN_KEY = Regex("""unknown key '([^']*)'""")
    private val UNKNOWN_NAME = Regex("""does not contain element with name '([^']*)'""")

    /**
     * The mission in [file].
     *
     * @throws MissionProblem if there is none.
     */
    fun read(file: Path): MissionSpec = try {
        parse(text(file), file.toString())
    } catch (missing: NoSuchFileException) {
        throw MissionProblem("$file: expected a mission (JSON), found no such file", missing)
    } catch (denied: AccessDeniedException) {
        throw MissionProblem("$file: expected a mission (JSON), found no permission to read it", denied)
    } catch (coding: CharacterCodingException) {
        throw MissionProblem("$file: expected a mission (JSON), found bytes that are no UTF-8 text", coding)
    } catch (failed: IOException) {
        throw MissionProblem("$file: expected a mission (JSON), found ${failed.message}", failed)
    }

    /**
     * The mission in [text], which messages call [name].
     *
     * @throws MissionProblem if there is none.
     */
    fun parse(text: String, name: String): MissionSpec = try {
        MissionSpec.fromJson(text)
    } catch (wrong: IllegalArgumentException) {
        throw MissionProblem(words(wrong.message.orEmpty(), text, name), wrong)
    }

    private fun text(file: Path): String {
        if (Files.isDirectory(file)) throw IOException("a directory")
        val bytes = Files.newInputStream(file).use { it.readNBytes(LONGEST + 1) }
        if (bytes.size > LONGEST) throw IOException("a file of more than $LONGEST bytes")
        return bytes.decodeToString(throwOnInvalidSequence = true)
    }

    /** The library's [message] about [text] as a person would put it, with the place in the file called [name]. */
    private fun words(message: String, text: String, name: String): String {
        val place = JsonPlace(text)
        val path = PATH.find(message)?.groupValues?.get(1) ?: "$"
        val end = text.trimEnd().length
        val stated = OFFSET.find(message)?.groupValues?.get(1)?.toInt()
        val offset = if ("'EOF'" in message) end else stated ?: place.of(path)
        val field = path.removePrefix("$").removePrefix(".")
        val at = if (field.isEmpty()) "" else " $field:"
        fun line(offset: Int, what: String) = "$name:${place.lineAndColumn(offset)}:$at $what"
        RULE.find(message)?.let { return line(offset, it.groupValues[1]) }
        MISSING.find(message)?.let { match ->
            val fields = match.groupValues[1].ifEmpty { match.groupValues[2] }
            return line(offset, "expected ${if (',' in fields) "the fields" else "the field"} $fields, found none")
        }
        val expected = expected(path)
        UNKNOWN_KEY.find(message)?.let {
            // The library points behind the key's quotation mark.
            val key = if (text.getOrNull(offset - 1) == '"') offset - 1 else offset
            return line(key, "expected $expected, found '${it.groupValues[1]}'")
        }
        UNKNOWN_NAME.find(message)?.let {
            return line(offset, "expected $expected, found '${it.groupValues[1]}'")
        }
        val value = place.of(path)
        if (stated != null && expected != null && stated in value..value + place.token(value).length) {
            return line(value, "expected $expected, found ${place.token(value)}")
        }
        val rest = message.removePrefix("not a mission: ").replace(OFFSET, "").replace(PATH, "")
        return line(offset, rest.replace("Unexpected JSON token :", "").replace(Regex(" +"), " ").trim())
    }

    /** What may stand at [path]; null where nothing may. */
    @OptIn(ExperimentalSerializationApi::class)
    private fun expected(path: String): String? {
        var descriptor: SerialDescriptor = MissionSpec.serializer().descriptor
        for (step in Regex("""[^.$\[\]]+""").findAll(path)) {
            val index = if (descriptor.kind == StructureKind.LIST) 0 else descriptor.getElementIndex(step.value)
            if (index !in 0 until descriptor.elementsCount) return null
            descriptor = descriptor.getElementDescriptor(index)
        }
        return when (descriptor.kind) {
            SerialKind.ENUM, StructureKind.CLASS -> "one of " + descriptor.elementNames.joinToString(", ")
            StructureKind.LIST -> "a list in brackets"
            PrimitiveKind.INT, PrimitiveKind.LONG -> "a whole number"
            PrimitiveKind.DOUBLE -> "a number"
            PrimitiveKind.BOOLEAN -> "true or false"
            PrimitiveKind.STRING -> "a text in quotes"
            else -> null
        }
    }
}
