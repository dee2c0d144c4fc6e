package stillwater.io

import java.io.FilterInputStream
import java.io.InputStream

/** Passes [stream] on unchanged and tells [progress] after every read how many bytes have gone through. */
internal class CountingStream(stream: InputStream, private val progress: (Long) -> Unit) : FilterInputStream(stream) {
    private var bytes = 0L

    override fun read(): Int {
        val byte = super.read()
        if (byte >= 0) progress(++bytes)
        return byte
    }

    override fun read(buffer: ByteArray, offset: Int, length: Int): Int {
        val count = super.read(buffer, offset, length)
        if (count > 0) {
            bytes += count
            progress(bytes)
        }
        return count
    }
}
