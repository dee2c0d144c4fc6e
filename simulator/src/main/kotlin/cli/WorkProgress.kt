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
 * A progress bar over [total] units of work on the error stream; silent where [shown] is false or nobody watches.
 *
 * Drawn from within [advance], at most once a percent: no thread of its own. May be told from any thread.
 *
 * @param unit what is counted, shown behind the numbers.
 */
class WorkProgress(
    terminal: Terminal,
    label: String,
    private val unit: String,
    private val total: Long,
    shown: Boolean,
) : AutoCloseable {
    private val bar: ThreadProgressTaskAnimator<Unit>? =
        if (shown && terminal.terminalInfo.outputInteractive) bar(terminal, label) else null
    private var nextShown = 0L

    private fun bar(terminal: Terminal, label: String): ThreadProgressTaskAnimator<Unit> = progressBarLayout {
        text(label)
        percentage()
        progressBar()
        completed(suffix = unit)
        timeRemaining()
    }.animateOnThread(Terminal(terminalInterface = ToErrorStream(terminal.terminalInterface)), total = total)

    /** Tells that [done] of the [total] are done. */
    @Synchronized
    fun advance(done: Long) {
        if (bar == null || done < nextShown) return
        nextShown = done + total / PERCENT
        bar.update { completed = done }
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
        const val PERCENT = 100
    }
}
