package stillwater.io

import stillwater.mission.MissionSpec
import java.io.IOException
import java.nio.charset.CharacterCodingException
import java.nio.file.AccessDeniedException
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path

/** Reads a mission's JSON file. */
internal object MissionSpecFile {
    private const val LONGEST = 1_000_000
    private const val EXPECTED = "a mission (JSON)"
    private val OFFSET = Regex("""at offset (\d+)""")

    /**
     * The mission in [file].
     *
     * @throws LogProblem if there is none; it names the line where that is known.
     */
    fun read(file: Path): MissionSpec {
        val text = text(file)
        return try {
            MissionSpec.fromJson(text)
        } catch (wrong: IllegalArgumentException) {
            val why = wrong.message.orEmpty().removePrefix("not a mission: ")
            val offset = OFFSET.find(why)?.groupValues?.get(1)?.toIntOrNull()?.coerceIn(0, text.length)
            val line = offset?.let { text.substring(0, it).count { char -> char == '\n' } + 1L }
            val column = offset?.let { it - text.lastIndexOf('\n', it - 1) }
            throw LogProblem(file, line, column?.toString(), EXPECTED, why)
        }
    }

    private fun text(file: Path): String = try {
        if (Files.isDirectory(file)) throw IOException("a directory")
        val bytes = Files.newInputStream(file).use { it.readNBytes(LONGEST + 1) }
        if (bytes.size > LONGEST) throw IOException("a file of more than $LONGEST bytes")
        bytes.decodeToString(throwOnInvalidSequence = true)
    } catch (_: NoSuchFileException) {
        throw problem(file, "no such file")
    } catch (_: AccessDeniedException) {
        throw problem(file, "no permission to read it")
    } catch (_: CharacterCodingException) {
        throw problem(file, "bytes that are no UTF-8 text")
    } catch (failed: IOException) {
        throw problem(file, failed.message ?: failed.javaClass.simpleName)
    }

    private fun problem(file: Path, found: String) = LogProblem(file, null, null, EXPECTED, found)
}
