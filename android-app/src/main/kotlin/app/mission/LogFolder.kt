package stillwater.app.mission

import stillwater.app.mayWait
import stillwater.field.FieldMap
import stillwater.mission.MissionRecovery
import stillwater.mission.RecoveryListener
import stillwater.model.Position
import stillwater.model.Reading
import java.io.File
import java.io.IOException
import java.time.Instant
import java.time.ZoneOffset
import java.time.format.DateTimeFormatter

/**
 * The folder of the missions' logs. Touches the disk: for the disk's thread.
 *
 * @param place where it is, asked for at the first use, as that touches the disk, too; made where it is not there.
 * @param opener opens files.
 * @param room that is left on the disk, bytes.
 */
internal class LogFolder(
    place: () -> File,
    private val opener: LogOpener = LogOpener(::FileOutput),
    room: (() -> Long)? = null,
) {
    private val folder by lazy(place)
    private val room = room ?: ::roomOnDisk

    /** A log for the mission [name], begun at [epochMillis], Unix time, ms; on the disk from its first flush on. */
    fun begin(name: String, epochMillis: Long): LogFile {
        val stamp = STAMP.format(Instant.ofEpochMilli(epochMillis))
        val plain = name.map { if (it.isLetterOrDigit()) it else '-' }.joinToString("").take(LONGEST_NAME)
        return LogFile(File(folder, "$stamp-$plain$LOG$INCOMPLETE"), ::open, room)
    }

    /** The log [name], to go on with. */
    fun goOn(name: String): LogFile = LogFile(File(folder, name), ::open, room)

    /** What the incomplete log tells that was written last; null where there is none. Others stay. */
    fun recover(): RecoveredRun? =
        files()
            .filter { it.name.endsWith(INCOMPLETE) }
            // A mission that was gone on with may have been begun before one that was not.
            .map { it.lastModified() to it }
            .sortedWith(compareByDescending<Pair<Long, File>> { it.first }.thenByDescending { it.second.name })
            .firstNotNullOfOrNull { read(it.second) }

    /** What the incomplete log [name] tells; null where it is not there, or has no mission in it. */
    fun recover(name: String): RecoveredRun? =
        files().find { it.name == name && name.endsWith(INCOMPLETE) }?.let(::read)

    /** All logs, newest first. */
    fun past(): List<PastMission> =
        files().sortedByDescending { it.name }.map {
            PastMission(it.name, it.length(), !it.name.endsWith(INCOMPLETE), it.lastModified())
        }

    private fun roomOnDisk(): Long {
        mayWait("the room on the disk")
        return folder.usableSpace
    }

    private fun read(file: File): RecoveredRun? {
        mayWait("read a log")
        val trace = Trace()
        val track = Track()
        val recovery =
            MissionRecovery(
                object : RecoveryListener {
                    override fun took(reading: Reading, map: FieldMap) = trace.take(reading, map)

                    override fun at(place: Position) = track.add(place)
                },
            )
        return try {
            file.useLines { lines -> lines.forEach(recovery::line) }
            recovery.recovered()?.let { RecoveredRun(file.name, it, trace, track) }
        } catch (_: IOException) {
            null
        }
    }

    private fun open(file: File): LogOutput {
        mayWait("make a log's folder")
        if (!folder.isDirectory && !folder.mkdirs()) throw NoFolder()
        return opener.open(file)
    }

    private fun files(): List<File> {
        mayWait("list logs")
        return folder.listFiles().orEmpty().filter { it.name.endsWith(LOG) || it.name.endsWith(LOG + INCOMPLETE) }
    }

    companion object {
        const val LOG = ".log"

        /** What a log's name ends with until its mission is over. */
        const val INCOMPLETE = ".incomplete"
        private const val LONGEST_NAME = 40
        private val STAMP = DateTimeFormatter.ofPattern("yyyy-MM-dd'T'HH-mm-ss").withZone(ZoneOffset.UTC)
    }
}
