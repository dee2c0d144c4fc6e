package stillwater.cli

import stillwater.sensor.SensorSpec
import java.io.IOException
import java.nio.charset.CharacterCodingException
import java.nio.file.AccessDeniedException
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.Path

/** A sensor spec named on the command line. */
internal object SensorFile {
    private const val LONGEST_SPEC = 1_000_000

    /** The spec in [file], or a [BadFlag] of [flag] that says what is wrong with it. */
    fun read(flag: String, file: String): SensorSpec {
        val expected = "a sensor spec in $file"
        return try {
            SensorSpec.fromJson(text(Path.of(file)))
        } catch (problem: NoSuchFileException) {
            throw BadFlag(flag, expected, "no such file (${problem.file})")
        } catch (problem: AccessDeniedException) {
            throw BadFlag(flag, expected, "no permission to read it (${problem.file})")
        } catch (_: CharacterCodingException) {
            throw BadFlag(flag, expected, "bytes that are no UTF-8 text")
        } catch (problem: IOException) {
            throw BadFlag(flag, expected, problem.message ?: problem.javaClass.simpleName)
        } catch (problem: IllegalArgumentException) {
            throw BadFlag(flag, expected, problem.message.orEmpty().removePrefix("not a sensor spec: "))
        }
    }

    /** The text of [file], unless it is longer than any sensor spec. */
    private fun text(file: Path): String {
        if (Files.isDirectory(file)) throw IOException("a directory")
        val bytes = Files.newInputStream(file).use { it.readNBytes(LONGEST_SPEC + 1) }
        if (bytes.size > LONGEST_SPEC) throw IOException("a file of more than $LONGEST_SPEC bytes")
        return bytes.decodeToString(throwOnInvalidSequence = true)
    }
}
