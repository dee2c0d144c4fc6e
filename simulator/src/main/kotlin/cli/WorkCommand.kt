package stillwater.cli

import com.github.ajalt.clikt.core.CliktCommand
import com.github.ajalt.clikt.core.CliktError
import com.github.ajalt.clikt.core.context
import stillwater.io.JsonFileProblem
import stillwater.io.LogProblem
import stillwater.report.OutputException
import stillwater.report.counted
import java.nio.file.Path

/** A command whose every way to fail is one line that begins with its name, and exit code [BAD_INPUT]. */
abstract class WorkCommand(name: String) : CliktCommand(name) {
    init {
        context {
            helpFormatter = { OneLineErrors(it) }
            suggestTypoCorrection = OneLineErrors::suggestion
        }
    }

    /**
     * What the command does. May throw [BadFlag], [LogProblem], [JsonFileProblem] and [OutputException] besides
     * [failure].
     */
    protected abstract fun work()

    final override fun run() {
        try {
            work()
        } catch (wrong: BadFlag) {
            throw wrong.of(currentContext)
        } catch (problem: LogProblem) {
            throw failure(problem.message.orEmpty())
        } catch (problem: JsonFileProblem) {
            throw failure(problem.message.orEmpty())
        } catch (problem: OutputException) {
            throw failure(problem.message.orEmpty())
        }
    }

    /** What to say of the files [written] into [directory], of which [first] is the one to look at; null for none. */
    protected fun wrote(written: List<Path>, directory: String, first: String? = null): String {
        val look = first?.let { ", see ${Path.of(directory).resolve(it)}" }.orEmpty()
        return "wrote ${counted(written.size, "file")} into $directory$look"
    }

    /** The end of the command because of [message]. */
    protected fun failure(message: String): CliktError =
        CliktError("stillwater $commandName: $message", statusCode = BAD_INPUT)
}
