package stillwater.cli

import java.io.FileDescriptor
import java.io.FileOutputStream
import java.io.FilterOutputStream
import java.io.IOException
import java.io.OutputStream
import java.io.PrintStream
import java.nio.charset.Charset

/**
 * What becomes of what is printed. A reader that has seen enough, as `head` has, is no problem, and no reason to stop a
 * boat: what follows goes nowhere. A disk that is full is one, told at the end by [isLost].
 *
 * @param stream where it goes. Retained. @param charset of what is printed.
 */
internal class StandardOutput(stream: OutputStream, charset: Charset = Charsets.UTF_8) {
    /** Whether something could not be written that somebody may be waiting for. */
    @Volatile
    var isLost = false
        private set

    @Volatile
    private var isLeft = false

    /** To print to. */
    val printer = PrintStream(
        object : FilterOutputStream(stream) {
            override fun write(byte: Int) = guarded { out.write(byte) }

            override fun write(bytes: ByteArray, offset: Int, length: Int) = guarded {
                out.write(bytes, offset, length)
            }

            override fun flush() = guarded { out.flush() }
        }.buffered(),
        true,
        charset,
    )

    private inline fun guarded(write: () -> Unit) {
        if (isLeft) return
        try {
            write()
        } catch (failed: IOException) {
            // EPIPE; the JDK has only the system's words for it.
            isLeft = failed.message.orEmpty().contains("pipe", ignoreCase = true)
            isLost = !isLeft
        }
    }

    companion object {
        /** Stands in for System.out from now on, with the same encoding. */
        fun install(): StandardOutput {
            // Java 17 has the terminal's under a name of its own; later ones have stdout.encoding always.
            val encoding = listOf("stdout.encoding", "sun.stdout.encoding")
                .firstNotNullOfOrNull { name -> System.getProperty(name)?.takeIf(Charset::isSupported) }
            val charset = encoding?.let(Charset::forName) ?: Charset.defaultCharset()
            return StandardOutput(FileOutputStream(FileDescriptor.out), charset).also { System.setOut(it.printer) }
        }
    }
}
