package stillwater.boatserver

import stillwater.link.PhoneReport
import stillwater.link.ServedWire
import stillwater.wire.LineFramer

/**
 * The side of a virtual boat that tells its phone's program time, fixes and compass, one report at a time.
 *
 * One report is under way at a time. What cannot be read is counted. Confined to one thread.
 *
 * @param wire to the program. Retained, closed with this.
 */
internal class PhoneServer(private val wire: ServedWire) : AutoCloseable {
    private val buffer = ByteArray(BUFFER)
    private val framer = LineFramer({ bytes, start, end -> heard(String(bytes, start, end - start, Charsets.UTF_8)) })
    private var sent = 0L
    private var answered = 0L
    private var openings = 0L

    /** What the program is to be given. */
    val address: String get() = wire.address

    /** Times a report was not answered in time. */
    var unanswered = 0L
        private set

    /** Lines that were no answer. */
    var unreadable = 0L
        private set

    /** Whether the program is there; a fresh one has nothing to answer. */
    fun attend(): Boolean {
        val isHere = wire.attend()
        if (wire.openings != openings) {
            openings = wire.openings
            answered = sent
            framer.reset()
        }
        return isHere
    }

    /** Times a program came. */
    val visits: Long get() = wire.openings

    /** Sends [report]; for a program that hangs the one before must be answered first. */
    fun tell(report: PhoneReport) {
        check(answered >= sent) { "report $sent has not been answered" }
        val line = report.line().toByteArray()
        sent = report.tick
        wire.write(line, line.size)
    }

    /** Whether all that was told has been answered, after one more look at what has come: there may be no end to it. */
    fun isAnswered(): Boolean {
        val count = wire.read(buffer)
        if (count > 0) framer.accept(buffer, 0, count)
        return answered >= sent
    }

    /** Counts a report that was waited for in vain. */
    fun giveUp() {
        unanswered++
    }

    override fun close() = wire.close()

    private fun heard(line: String) {
        val tick = PhoneReport.answered(line)
        if (tick == null || tick > sent) unreadable++ else answered = maxOf(answered, tick)
    }

    private companion object {
        const val BUFFER = 4096
    }
}
