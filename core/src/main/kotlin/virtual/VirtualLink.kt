package stillwater.virtual

import stillwater.wire.ByteLink
import kotlin.random.Random

/**
 * What a link does to the bytes that pass.
 *
 * @property delay of every byte, s, at least 0.
 * @property loss probability that a byte is dropped, 0 to 1.
 * @property corruption probability that a byte arrives as another, 0 to 1.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class LinkSpec(val delay: Double = 0.02, val loss: Double = 0.0, val corruption: Double = 0.0) {
    init {
        require(delay >= 0 && delay.isFinite()) { "delay ($delay s) must be at least 0 and finite" }
        require(loss in 0.0..1.0) { "loss ($loss) must be in [0, 1]" }
        require(corruption in 0.0..1.0) { "corruption ($corruption) must be in [0, 1]" }
    }
}

/**
 * A link in virtual time that delays, drops, corrupts and can be cut, both ways.
 *
 * While it is cut, what is sent is lost, and so is what is on its way. [advance] moves its clock. At most [CAPACITY] bytes
 * are on the way in each direction; more are lost, as in a full buffer. Deterministic. Confined to one thread.
 *
 * @property spec what it does.
 * @param random where losses come from. Retained.
 */
public class VirtualLink(public val spec: LinkSpec, private val random: Random) {
    private val toPhone = Pipe()
    private val toBoard = Pipe()
    private var now = 0.0

    /** Whether nothing passes. What is on its way is lost when it becomes so. */
    public var isCut: Boolean = false
        set(value) {
            field = value
            if (value) {
                toPhone.clear()
                toBoard.clear()
            }
        }

    /** The phone's end. A cut is not told: bytes just stop, as with Bluetooth out of range. */
    public val phone: ByteLink = end(toPhone, toBoard)

    /** The board's end. */
    public val board: ByteLink = end(toBoard, toPhone)

    /** Lets [dt] s pass; not above 0 or not finite passes none. */
    public fun advance(dt: Double) {
        if (dt > 0 && dt.isFinite()) now += dt
    }

    private fun end(inbound: Pipe, outbound: Pipe) = object : ByteLink {
        override fun read(into: ByteArray): Int = inbound.take(into)

        override fun write(bytes: ByteArray): Boolean {
            if (!isCut) for (byte in bytes) outbound.put(byte)
            return true
        }
    }

    private inner class Pipe {
        private val bytes = ByteArray(CAPACITY)
        private val due = DoubleArray(CAPACITY)
        private var first = 0
        private var size = 0

        fun clear() {
            size = 0
        }

        fun put(byte: Byte) {
            if (size == CAPACITY || random.nextDouble() < spec.loss) return
            val at = (first + size++) % CAPACITY
            bytes[at] = if (random.nextDouble() < spec.corruption) (byte + random.nextInt(1, 256)).toByte() else byte
            due[at] = now + spec.delay
        }

        fun take(into: ByteArray): Int {
            var count = 0
            while (size > 0 && count < into.size && due[first] <= now) {
                into[count++] = bytes[first]
                first = (first + 1) % CAPACITY
                size--
            }
            return count
        }
    }

    public companion object {
        /** Most bytes on the way in one direction. */
        public const val CAPACITY: Int = 4096
    }
}
