package stillwater.survey

import stillwater.io.ReadingSink
import stillwater.model.BoatTime
import stillwater.model.Conditions

/**
 * The readings of a log, without their conditions, to be gone through again: parsing a file takes longer than all the
 * filters do. Holds the first [MOST]; of a longer log it is of no use, see [holds].
 */
internal class KeptReadings : ReadingSink {
    private val blocks = ArrayList<DoubleArray>()
    private var size = 0

    override fun take(time: BoatTime, x: Double, y: Double, value: Double, conditions: Conditions) {
        if (size == MOST) {
            // Too long to be kept: what is here is let go.
            blocks.clear()
            return
        }
        val place = size % BLOCK * WIDTH
        if (place == 0) blocks += DoubleArray(BLOCK * WIDTH)
        val block = blocks.last()
        block[place] = time.seconds
        block[place + 1] = x
        block[place + 2] = y
        block[place + 3] = value
        size++
    }

    /** Whether all of a log of [readings] is here. */
    fun holds(readings: Long): Boolean = size.toLong() == readings

    /** Hands all readings to [sink]. */
    fun read(sink: ReadingSink) {
        for (i in 0 until size) {
            val block = blocks[i / BLOCK]
            val at = i % BLOCK * WIDTH
            sink.take(BoatTime(block[at]), block[at + 1], block[at + 2], block[at + 3], Conditions.NONE)
        }
    }

    internal companion object {
        /** 64 MB. */
        const val MOST = 2_000_000
        private const val WIDTH = 4
        private const val BLOCK = 1 shl 13
    }
}
