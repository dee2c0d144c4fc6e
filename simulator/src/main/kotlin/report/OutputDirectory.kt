package stillwater.report

import java.io.IOException
import java.io.OutputStream
import java.nio.file.AccessDeniedException
import java.nio.file.AtomicMoveNotSupportedException
import java.nio.file.FileAlreadyExistsException
import java.nio.file.FileSystemException
import java.nio.file.Files
import java.nio.file.NoSuchFileException
import java.nio.file.NotDirectoryException
import java.nio.file.Path
import java.nio.file.StandardCopyOption.ATOMIC_MOVE
import java.nio.file.StandardCopyOption.REPLACE_EXISTING
import kotlin.io.path.exists
import kotlin.io.path.isDirectory
import kotlin.io.path.isWritable

/** An output that could not be written; the message is one line and names the path. */
public class OutputException(message: String, cause: Throwable? = null) : RuntimeException(message, cause)

/**
 * A directory of results that is written aside and moved into place when complete.
 *
 * Files go into a staging directory beside [directory]; [commit] moves them over, each file atomically, replacing
 * files of the same name and leaving others alone. Without a commit (an exception, an interrupted program) nothing
 * in [directory] changes and the staging directory is removed.
 *
 * Confined to one thread. Close it in all cases: `OutputDirectory(path).use { ...; it.commit() }`.
 *
 * @property directory where the results go; it and its parents are created on commit if missing.
 * @param inputs files that were read and are not to be replaced. Retained.
 * @param earlier whose results these are: files of the same names that are not of such are somebody's own, and stay. Null for
 *   a command that sees to that itself.
 * @throws OutputException if [directory] is a file, cannot be written, or has the report of another command.
 */
public class OutputDirectory(
    public val directory: Path,
    private val inputs: List<Path> = emptyList(),
    private val earlier: EarlierResults? = null,
) : AutoCloseable {
    private val target = directory.toAbsolutePath().normalize()
    private val createdParents = ArrayList<Path>()
    private val staging: Path
    private val names = ArrayList<String>()
    private val retired = LinkedHashSet<String>()
    private val removal = Thread({ discard() }, "remove unfinished output")
    private val lock = Any()
    private var isOpen = true

    /** Whether what is in a directory is of an earlier run. */
    private val own = HashMap<Path, Boolean>()

    init {
        if (target.exists() && !target.isDirectory()) {
            throw OutputException("output $directory is a file; name a directory")
        }
        if (target.exists() &&
            !target.isWritable()
        ) {
            throw OutputException("output directory $directory is not writable")
        }
        requireOwn(EarlierResults.REPORT)
        staging = guarded("create") { createStaging() }
        Runtime.getRuntime().addShutdownHook(removal)
    }

    /** Writes [text] as UTF-8 under [name], a path relative to the directory such as `results.csv`. */
    public fun write(name: String, text: String): Unit = write(name, text.toByteArray())

    /** Writes [bytes] under [name], a path relative to the directory such as `figure-6.png`. Not modified. */
    public fun write(name: String, bytes: ByteArray): Unit = stream(name) { it.write(bytes) }

    /**
     * Lets [block] write the file [name] piece by piece, buffered; for results larger than memory. An IOException
     * from [block] counts as the disk's refusal, so [block] should not read other files.
     *
     * @throws OutputException if the disk refuses or the file is an input that would not stay as it is, and [block]'s
     * own exceptions unchanged.
     */
    public fun <T> stream(name: String, block: (OutputStream) -> T): T {
        check(isOpen) { "output directory $directory is already committed or closed" }
        val file = staging.resolve(name).normalize()
        require(file.startsWith(staging) && file != staging) {
            "name ($name) must be a path inside the output directory"
        }
        requireOwn(name)
        return guarded("write $name in") {
            Files.createDirectories(file.parent)
            val written = Files.newOutputStream(file).buffered().use(block)
            if (isInput(name) && Files.mismatch(file, target.resolve(name)) != SAME) throw isInputItself(name)
            if (name !in names) names += name
            written
        }
    }

    /**
     * Names files of an earlier run that must not stand beside this run's results: those of [names] that were not written
     * are removed on [commit].
     */
    public fun retire(names: Collection<String>) {
        names.forEach(::requireOwn)
        retired += names
    }

    private fun requireOwn(name: String) {
        val file = target.resolve(name)
        if (earlier == null || !file.exists() || own.getOrPut(file.parent) { earlier.areIn(file.parent) }) return
        val place = directory.resolve(name)
        throw OutputException(
            "output $place is not of an earlier stillwater ${earlier.command}; name another directory",
        )
    }

    private fun isInput(name: String): Boolean {
        val place = target.resolve(name)
        return place.exists() && inputs.any { it.exists() && Files.isSameFile(it, place) }
    }

    private fun isInputItself(name: String) =
        OutputException("output ${directory.resolve(name)} is the input itself; name another directory")

    /**
     * Moves everything written into place, in the order of writing.
     *
     * @return the files' paths, [directory] first in each, in that order.
     * @throws OutputException if a file cannot be moved, or one that was retired is an input; files not yet moved are
     * then dropped.
     */
    public fun commit(): List<Path> = synchronized(lock) {
        check(isOpen) { "output directory $directory is already committed or closed" }
        val gone = retired - names.toSet()
        gone.firstOrNull(::isInput)?.let { throw isInputItself(it) }
        names.firstOrNull { target.resolve(it).isDirectory() }?.let {
            throw OutputException("cannot write ${directory.resolve(it)}: a directory of this name is in the way")
        }
        try {
            guarded("write") {
                for (name in names) {
                    val place = target.resolve(name)
                    Files.createDirectories(place.parent)
                    move(staging.resolve(name), place)
                }
                Files.createDirectories(target)
                for (name in gone) Files.deleteIfExists(target.resolve(name))
            }
            createdParents.clear()
        } finally {
            close()
        }
        names.map(directory::resolve)
    }

    /** Removes what was not committed. Calling it again does nothing. */
    override fun close() {
        discard()
        try {
            Runtime.getRuntime().removeShutdownHook(removal)
        } catch (_: IllegalStateException) {
            // The program is already shutting down; the hook finds nothing left to do.
        }
    }

    private fun discard(): Unit = synchronized(lock) {
        if (!isOpen) return
        isOpen = false
        staging.toFile().deleteRecursively()
        // Parents made for the staging directory only go again; a directory that has other content stays.
        createdParents.asReversed().forEach { it.toFile().delete() }
    }

    /** Beside the target, or inside it where only the target itself may be written (a mounted volume). */
    private fun createStaging(): Path {
        val parent = target.parent ?: target
        generateSequence(parent) { it.parent }.takeWhile { !it.exists() }.toList().asReversed().forEach {
            Files.createDirectory(it)
            createdParents.add(it)
        }
        val prefix = ".${target.fileName ?: "output"}-unfinished-"
        return if (!parent.isWritable() && target.isDirectory()) {
            Files.createTempDirectory(target, prefix)
        } else {
            Files.createTempDirectory(parent, prefix)
        }
    }

    private fun move(from: Path, to: Path) {
        try {
            Files.move(from, to, ATOMIC_MOVE, REPLACE_EXISTING)
        } catch (_: AtomicMoveNotSupportedException) {
            // The target is another file system: copy beside the final name first, so that the last step is atomic.
            val near = Files.createTempFile(to.parent, ".${to.fileName}-", ".unfinished")
            try {
                Files.copy(from, near, REPLACE_EXISTING)
                Files.move(near, to, ATOMIC_MOVE, REPLACE_EXISTING)
            } finally {
                Files.deleteIfExists(near)
            }
        }
    }

    private inline fun <T> guarded(what: String, block: () -> T): T = try {
        block()
    } catch (failed: IOException) {
        throw OutputException("cannot $what output directory $directory: ${reason(failed)}", failed)
    }

    private fun reason(failed: IOException): String = when (failed) {
        is AccessDeniedException -> "permission denied"
        is FileAlreadyExistsException -> "${failed.file} is a file"
        is NoSuchFileException -> "the system lets nothing be created there"
        is NotDirectoryException -> "${failed.file} is not a directory"
        is FileSystemException -> failed.reason ?: failed.javaClass.simpleName
        else -> failed.message ?: failed.javaClass.simpleName
    }.lineSequence().first()

    private companion object {
        /** What [Files.mismatch] says of files with the same bytes. */
        const val SAME = -1L
    }
}
