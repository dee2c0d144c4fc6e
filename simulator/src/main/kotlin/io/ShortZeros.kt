package stillwater.io

import java.io.FilterReader
import java.io.Reader

/**
 * A text with its long runs of zero characters made short: where a disk lost megabytes, a row is not to be longer than a
 * reader holds. What is left of a run is more than [MOST] of them where it was. Runs of less are as they were.
 *
 * Whole buffers are left out, so that other texts cost nothing. Confined to one thread.
 */
internal class ShortZeros(text: Reader) : FilterReader(text) {
    private var inRun = 0

    override fun read(): Int {
        val one = CharArray(1)
        return if (read(one, 0, 1) < 0) -1 else one[0].code
    }

    override fun read(buffer: CharArray, offset: Int, length: Int): Int {
        while (true) {
            val count = super.read(buffer, offset, length)
            if (count <= 0) return count
            val zeros = if (buffer[offset + count - 1] == ZERO) zerosAtTheEnd(buffer, offset, count) else 0
            if (zeros < count) {
                inRun = zeros
                return count
            }
            if (inRun <= MOST) {
                inRun += count
                return count
            }
        }
    }

    private fun zerosAtTheEnd(buffer: CharArray, offset: Int, count: Int): Int {
        var zeros = 0
        while (zeros < count && buffer[offset + count - 1 - zeros] == ZERO) zeros++
        return zeros
    }

    companion object {
        /** Zeros of a run that are never left out. */
        const val MOST = 500_000
        private const val ZERO = '\u0000'
    }
}
