package stillwater.io

import stillwater.model.JsonProblem
import java.io.IOException
import java.nio.charset.CharacterCodingException
import java.nio.file.AccessDeniedException
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path

/** A JSON file that cannot be used: one line that names the file, the line, the column, the field and what was expected. */
class JsonFileProblem(message: String, cause: Throwable? = null) : Exception(message, cause)

/**
 * Reads files of JSON that people write.
 *
 * @param what is in them, with its article, such as `a mission (JSON)`.
 * @param longest that is read, bytes.
 */
internal class JsonFile(private val what: String, private val longest: Int = 10_000_000) {
    /**
     * What [parse] makes of the text of [file].
     *
     * @throws JsonFileProblem if it cannot be read or [parse] throws a [JsonProblem].
     */
    fun <T> read(file: Path, parse: (String) -> T): T = parse(text(file), file.toString(), parse)

    /** As [read], of [text], which messages call [name]. */
    fun <T> parse(text: String, name: String, parse: (String) -> T): T = try {
        parse(text)
    } catch (wrong: JsonProblem) {
        throw JsonFileProblem("$name:${wrong.place}: ${wrong.words}", wrong)
    }

    private fun text(file: Path): String {
        fun problem(found: String, cause: Exception) = JsonFileProblem("$file: expected $what, found $found", cause)
        return try {
            if (Files.isDirectory(file)) throw IOException("a directory")
            val bytes = Files.newInputStream(file).use { it.readNBytes(longest + 1) }
            if (bytes.size > longest) throw IOException("a file of more than $longest bytes")
            bytes.decodeToString(throwOnInvalidSequence = true)
        } catch (missing: NoSuchFileException) {
            throw problem("no such file", missing)
        } catch (denied: AccessDeniedException) {
            throw problem("no permission to read it", denied)
        } catch (coding: CharacterCodingException) {
            throw problem("bytes that are no UTF-8 text", coding)
        } catch (failed: IOException) {
            throw problem(failed.message ?: failed.javaClass.simpleName, failed)
        }
    }
}
