package stillwater.cli

import stillwater.drive.LogOnDisk
import stillwater.report.OutputException
import java.nio.file.Path
import kotlin.io.path.exists

/**
 * Refuses a [directory] with a mission's log that is not this command's: one from the water cannot be had again.
 *
 * @param own file that this command writes beside its logs, and no other does.
 * @throws OutputException if there is such a log.
 */
internal fun requireNoOtherMission(directory: Path, own: String) {
    val finished = LogOnDisk.finished(directory).takeUnless { directory.resolve(own).exists() }
    val found = LogOnDisk.unfinished(directory) ?: finished ?: return
    throw hasLog(directory, "another mission", found)
}

/**
 * Refuses a [directory] with any mission's log: this command has files of the same names as those beside the log, in
 * another form.
 *
 * @throws OutputException if there is such a log.
 */
internal fun requireNoMission(directory: Path) {
    val found = LogOnDisk.unfinished(directory) ?: LogOnDisk.finished(directory) ?: return
    throw hasLog(directory, "a mission", found)
}

private fun hasLog(directory: Path, whose: String, log: Path) =
    OutputException("output directory $directory has the log of $whose, $log; name another directory")
