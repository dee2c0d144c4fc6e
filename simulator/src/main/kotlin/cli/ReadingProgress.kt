package stillwater.cli

import com.github.ajalt.mordant.animation.progress.ThreadProgressTaskAnimator
import com.github.ajalt.mordant.animation.progress.animateOnThread
import com.github.ajalt.mordant.terminal.PrintRequest
import com.github.ajalt.mordant.terminal.Terminal
import com.github.ajalt.mordant.terminal.TerminalInterface
import com.github.ajalt.mordant.widgets.progress.completed
import com.github.ajalt.mordant.widgets.progress.percentage
import com.github.ajalt.mordant.widgets.progress.progressBar
import com.github.ajalt.mordant.widgets.progress.progressBarLayout
import com.github.ajalt.mordant.widgets.progress.text
import com.github.ajalt.mordant.widgets.progress.timeRemaining

/**
 * A progress bar over [total] bytes on the error stream; silent where [shown] is false or nobody watches.
 *
 * Drawn from within [advance], at most once a percent: no thread of its own.
 */
class ReadingProgress(terminal: Terminal, label: String, private val total: Long, shown: Boolean) : AutoCloseable {
    private val bar: ThreadProgressTaskAnimator<Unit>? =
        if (shown && total >= WORTH_SHOWING && terminal.terminalInfo.outputInteractive) bar(terminal, label) else null
    private var nextByte = 0L

    private fun bar(terminal: Terminal, label: String): ThreadProgressTaskAnimator<Unit> = progressBarLayout {
        text(label)
        percentage()
        progressBar()
        completed(suffix = "B")
        timeRemaining()
    }.animateOnThread(Terminal(terminalInterface = ToErrorStream(terminal.terminalInterface)), total = total)

    /** Tells that [bytes] are done. */
    fun advance(bytes: Long) {
        if (bar == null || bytes < nextByte) return
        nextByte = bytes + total / PERCENT
        bar.update { completed = bytes }
        bar.refresh()
    }

    /** Wipes the bar. */
    override fun close() {
        bar?.clear()
    }

    private class ToErrorStream(private val standard: TerminalInterface) : TerminalInterface by standard {
        override fun completePrintRequest(request: PrintRequest) =
            standard.completePrintRequest(request.copy(stderr = true))
    }

    private companion object {
        /** Smaller files are done before a bar can be read. */
        const val WORTH_SHOWING = 8_000_000L
        const val PERCENT = 100
    }
}
