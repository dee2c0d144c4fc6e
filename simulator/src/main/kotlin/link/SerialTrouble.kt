package stillwater.link

/**
 * Why a serial port cannot be opened.
 *
 * @property why in words, and what to do.
 */
internal enum class SerialTrouble(private val why: String) {
    /** No such port. */
    NOT_THERE("expected a serial port, found none"),

    /** Somebody else has it. */
    BUSY("another program has this port open (a terminal, a modem manager, another stillwater); end that one first"),

    /** It belongs to others. */
    FORBIDDEN(
        "no permission to open this port; on Linux it is the group's that `ls -l` shows, often dialout: " +
            "sudo usermod -aG dialout YOU, then log in again",
    ),

    /** A file or device of another kind. */
    NO_PORT("expected a serial port, found something else of this name"),

    /** Anything else. */
    OTHER("this port cannot be opened"),
    ;

    /** In one line: [name] is the port, [ports] the system's list of them, [error] the system's number; 0 for none. */
    fun words(name: String, ports: List<String>, error: Int = 0): String {
        val number = if (this == OTHER) " (error $error)" else ""
        val isListed = name in ports
        // A system lists ports that it has a driver for, also where there is no hardware.
        val isEmpty = this == NO_PORT && isListed
        val what = if (isEmpty) "expected a serial port, found a name with no port behind it" else why
        val others = ports - name
        val which = when {
            others.isNotEmpty() -> "there are ${others.joinToString()}"
            isListed -> "this machine has no other"
            else -> "this machine has no serial ports"
        }
        return "$name: $what$number; $which"
    }

    companion object {
        private const val WINDOWS_NO_FILE = 2
        private const val WINDOWS_NO_PATH = 3
        private const val WINDOWS_DENIED = 5
        private const val WINDOWS_IN_USE = 32

        /** Numbers of Linux and macOS: EPERM, ENOENT, ENXIO, EAGAIN of both, EACCES, EBUSY, ENODEV, ENOTTY. */
        private val UNIX = mapOf(
            1 to FORBIDDEN,
            2 to NOT_THERE,
            6 to NOT_THERE,
            11 to BUSY,
            13 to FORBIDDEN,
            16 to BUSY,
            19 to NOT_THERE,
            25 to NO_PORT,
            35 to BUSY,
        )

        /** What the system's [error] means. */
        fun of(error: Int, isWindows: Boolean): SerialTrouble = if (isWindows) {
            when (error) {
                WINDOWS_NO_FILE, WINDOWS_NO_PATH -> NOT_THERE
                // Windows denies a port that somebody else has open.
                WINDOWS_DENIED, WINDOWS_IN_USE -> BUSY
                else -> OTHER
            }
        } else {
            UNIX[error] ?: OTHER
        }
    }
}
