package stillwater.app.mission

import stillwater.app.mayWait
import java.io.File
import java.io.IOException
import java.io.RandomAccessFile

/** Where a log's bytes go. A seam, for a test has no full disk. May wait: for the disk's thread. */
internal interface LogOutput {
    /** Appends all of [bytes] and has them on the disk. @throws IOException where not all could be; then none is. */
    @Throws(IOException::class)
    fun append(bytes: ByteArray)

    /** Lets go of the file. */
    fun close()
}

/** Opens the output of a file. */
internal fun interface LogOpener {
    /** Opens [file], made where it is not there, to append to it. */
    @Throws(IOException::class)
    fun open(file: File): LogOutput
}

/** A file that is only ever longer; what could be appended in part only is taken off again. */
internal class FileOutput(file: File) : LogOutput {
    init {
        mayWait("open a log")
    }

    private val access = RandomAccessFile(file, "rw")
    private var length = access.length()

    init {
        // The last line of a process that was ended may be cut; what comes now is not the rest of it.
        if (length > 0) {
            access.seek(length - 1)
            if (access.read() != '\n'.code) append(byteArrayOf('\n'.code.toByte()))
        }
    }

    override fun append(bytes: ByteArray) {
        mayWait("write a log")
        try {
            access.seek(length)
            access.write(bytes)
            access.fd.sync()
            length += bytes.size
        } catch (error: IOException) {
            try {
                access.setLength(length)
            } catch (also: IOException) {
                error.addSuppressed(also)
            }
            throw error
        }
    }

    override fun close() {
        mayWait("close a log")
        access.close()
    }
}
