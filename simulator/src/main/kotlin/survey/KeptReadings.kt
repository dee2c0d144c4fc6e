package stillwater.survey

import stillwater.io.ReadingSink

/**
 * The readings of a log, without their conditions, to be gone through again: parsing a file takes longer than all the
 * filters do. Holds the first [MOST]; of a longer log it is of no use, see [holds].
 */
internal class KeptReadings {
    private val blocks = ArrayList<ReadingBlock>()
    private var size = 0L

    /** Keeps [block], which is not added to any more. */
    fun take(block: ReadingBlock) {
        size += block.size
        // Too long to be kept: what is here is let go.
        if (size > MOST) blocks.clear() else blocks += block
    }

    /** Whether all of a log of [readings] is here. */
    fun holds(readings: Long): Boolean = size == readings && size <= MOST

    /** Hands all readings to [sink]. */
    fun read(sink: ReadingSink) {
        for (block in blocks) block.read(sink)
    }

    internal companion object {
        /** 64 MB. */
        const val MOST = 2_000_000
    }
}
