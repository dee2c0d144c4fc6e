package stillwater.virtual

import org.junit.jupiter.api.Test
import stillwater.model.Actuation
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.LineFramer
import stillwater.wire.Message
import stillwater.wire.PlatypusCodec
import stillwater.wire.PlatypusEncoder
import kotlin.random.Random
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class VirtualLinkTest {
    private val buffer = ByteArray(512)

    private fun ByteLink.taken() = buffer.copyOf(read(buffer))

    @Test
    fun bytesArriveAfterTheDelayAndInOrder() {
        val link = VirtualLink(LinkSpec(delay = 0.5), Random(1))
        link.phone.write(byteArrayOf(1, 2))
        link.advance(0.25)
        link.phone.write(byteArrayOf(3))
        assertEquals(0, link.board.read(buffer))
        link.advance(0.25)
        assertContentEquals(byteArrayOf(1, 2), link.board.taken())
        link.advance(0.25)
        assertContentEquals(byteArrayOf(3), link.board.taken())
        assertEquals(0, link.phone.read(buffer))
    }

    @Test
    fun aCutLosesWhatIsOnItsWay() {
        val link = VirtualLink(LinkSpec(delay = 0.5), Random(1))
        link.board.write(byteArrayOf(1))
        link.isCut = true
        link.board.write(byteArrayOf(2))
        link.isCut = false
        link.board.write(byteArrayOf(3))
        link.advance(1.0)
        assertContentEquals(byteArrayOf(3), link.phone.taken())
    }

    /** Byte for byte over a bad link: motors rest within the watchdog's time, every wrong line is counted. */
    @Test
    fun aBoardOverABadLinkRestsItsMotorsWithinPointSixSecondsOfACut() {
        var driven = 0
        for (seed in 501..540) {
            val random = Random(seed)
            val link = VirtualLink(LinkSpec(loss = 1e-3, corruption = 1e-3), random)
            val board = VirtualBoard(SPEC, false, { _, _ -> 7.5 }) { link.board.write(it.encodeToByteArray()) }
            var heard = 0
            val framer = LineFramer(PlatypusCodec { if (it is Message.Motor) heard++ })
            val cutAt = random.nextInt(1000, 2000)
            var restedAt = -1
            for (tick in 0 until cutAt + 100) {
                if (tick == cutAt) {
                    link.isCut = true
                    if (!board.actuation.isAtRest) driven++
                }
                if (tick % 10 == 0) link.phone.write(PlatypusEncoder.encode(Command.Move(AHEAD)))
                // Until the board acts on it: one lost byte loses the command.
                if (tick % 300 == 200 && board.actuation.isAtRest) link.phone.write(PlatypusEncoder.encode(Command.Arm))
                link.advance(0.01)
                framer.accept(buffer, 0, link.phone.read(buffer))
                board.receive(buffer, 0, link.board.read(buffer))
                board.advance(0.01)
                if (tick >= cutAt && restedAt < 0 && board.actuation.isAtRest) restedAt = tick
            }
            assertTrue(restedAt >= 0 && (restedAt - cutAt) * 0.01 <= 0.6, "seed $seed: ${restedAt - cutAt} ticks")
            // At 10 Hz and two motors a line from 4.1 s to 10 s at least; one line in ten is hit.
            assertTrue(heard > 90 || restedAt == cutAt, "seed $seed: $heard motors heard of")
        }
        // A cut meets a few boards while they still arm.
        assertTrue(driven >= 30, "$driven of 40 were under way")
    }

    private companion object {
        val SPEC = BoardSpec(watchdog = 0.5, arming = 2.0, booting = 1.5)
        val AHEAD = Actuation.Differential(0.5, 0.5)
    }
}
