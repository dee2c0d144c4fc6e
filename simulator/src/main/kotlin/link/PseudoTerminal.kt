package stillwater.link

import com.sun.jna.LastErrorException
import com.sun.jna.Library
import com.sun.jna.Memory
import com.sun.jna.Native
import com.sun.jna.Platform
import com.sun.jna.Pointer

/**
 * A board's wire on a pseudo-terminal, which looks like a serial port to any program. Linux only.
 *
 * It is raw: no echo, no line editing. Opening and closing of its other end are seen, as a board sees DTR. Source:
 * POSIX.1-2017, posix_openpt and following; pty(7) for what a master reads while nobody has the slave open. The calls
 * go through JNA, which the terminal library brings along.
 *
 * @throws WireProblem where there are no pseudo-terminals.
 */
internal class PseudoTerminal : ServedWire {
    @Suppress("FunctionNaming", "ktlint:standard:function-naming")
    private interface LibC : Library {
        fun posix_openpt(flags: Int): Int

        fun grantpt(master: Int): Int

        fun unlockpt(master: Int): Int

        fun ptsname(master: Int): String?

        fun open(path: String, flags: Int): Int

        fun close(descriptor: Int): Int

        fun read(descriptor: Int, into: ByteArray, length: Long): Long

        fun write(descriptor: Int, bytes: ByteArray, length: Long): Long

        fun poll(descriptors: Pointer, count: Long, timeoutMillis: Int): Int

        fun tcgetattr(descriptor: Int, settings: Pointer): Int

        fun tcsetattr(descriptor: Int, whenDone: Int, settings: Pointer): Int

        fun cfmakeraw(settings: Pointer)
    }

    private val libc: LibC = library()
    private val master: Int
    private val asked = Memory(POLL_SIZE)
    private val settings = Memory(SETTINGS_SIZE)
    private var isOpen = false
    private var isClosed = false

    override val address: String

    override var openings = 0L
        private set

    override var untaken = 0L
        private set

    init {
        master = libc.posix_openpt(READ_WRITE or NO_CONTROLLING or NON_BLOCKING or CLOSE_ON_EXEC)
        if (master < 0) throw WireProblem("no pseudo-terminal can be had (error ${Native.getLastError()}); $USE_TCP")
        val isReady = libc.grantpt(master) == 0 && libc.unlockpt(master) == 0
        val name = if (isReady) libc.ptsname(master) else null
        if (name == null) {
            val error = Native.getLastError()
            libc.close(master)
            throw WireProblem("the pseudo-terminal cannot be used (error $error); $USE_TCP")
        }
        address = name
        // The master hears of nobody being there only once somebody has been.
        val slave = libc.open(name, READ_WRITE or NO_CONTROLLING or CLOSE_ON_EXEC)
        if (slave >= 0) libc.close(slave)
        makeRaw()
    }

    override fun attend(): Boolean {
        asked.setInt(0, master)
        asked.setShort(EVENTS, 0)
        asked.setShort(FOUND, 0)
        val isHere = libc.poll(asked, 1, 0) >= 0 && asked.getShort(FOUND).toInt() and HUNG_UP == 0
        if (isHere && !isOpen) openings++
        // The kernel forgets the settings when the last one leaves.
        if (!isHere && isOpen) makeRaw()
        isOpen = isHere
        return isHere
    }

    override fun read(into: ByteArray): Int {
        if (!isOpen) return 0
        return maxOf(0L, libc.read(master, into, into.size.toLong())).toInt()
    }

    override fun write(bytes: ByteArray, length: Int) {
        val taken = if (isOpen) maxOf(0L, libc.write(master, bytes, length.toLong())) else 0
        untaken += length - taken
    }

    override fun close() {
        if (!isClosed) libc.close(master)
        isClosed = true
        isOpen = false
    }

    private fun makeRaw() {
        if (libc.tcgetattr(master, settings) != 0) return
        libc.cfmakeraw(settings)
        libc.tcsetattr(master, NOW, settings)
    }

    private companion object {
        const val USE_TCP = "use --tcp PORT"
        const val READ_WRITE = 2
        const val NO_CONTROLLING = 0x100
        const val NON_BLOCKING = 0x800
        const val CLOSE_ON_EXEC = 0x80000
        const val HUNG_UP = 0x10
        const val NOW = 0

        /** struct pollfd: int fd, short events, short revents. */
        const val POLL_SIZE = 8L
        const val EVENTS = 4L
        const val FOUND = 6L

        /** Larger than any struct termios (60 bytes). */
        const val SETTINGS_SIZE = 256L

        fun library(): LibC {
            if (!Platform.isLinux()) {
                val system = System.getProperty("os.name")
                throw WireProblem("a pseudo-terminal is made on Linux only, this is $system; $USE_TCP")
            }
            return try {
                Native.load("c", LibC::class.java)
            } catch (missing: UnsatisfiedLinkError) {
                throw WireProblem("no pseudo-terminal: the C library is not to be had; $USE_TCP", missing)
            } catch (failed: LastErrorException) {
                throw WireProblem("no pseudo-terminal (${failed.message}); $USE_TCP", failed)
            }
        }
    }
}
