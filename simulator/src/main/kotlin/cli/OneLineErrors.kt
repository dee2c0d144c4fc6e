package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.MultiUsageError
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.output.HelpFormatter
import com.github.ajalt.clikt.output.MordantHelpFormatter
import stillwater.io.NearName

/** Help as usual, but a wrong command line is answered in one line: `stillwater map: no such option --foo`. */
class OneLineErrors(context: Context) : MordantHelpFormatter(context, showDefaultValues = true) {
    override fun formatHelp(
        error: UsageError?,
        prolog: String,
        epilog: String,
        parameters: List<HelpFormatter.ParameterHelp>,
        programName: String,
    ): String {
        if (error == null) return super.formatHelp(null, prolog, epilog, parameters, programName)
        val all = (error as? MultiUsageError)?.errors ?: listOf(error)
        val formatter = parameterFormatter(context)
        val oneLine = all.joinToString("; ") { onOneLine(it.formatMessage(context.localization, formatter)) }
        // Clikt does not know of which command an option is that there is none of, nor of which several errors are.
        val name = if (error.context == null) innermost().commandNameWithParents().joinToString(" ") else programName
        return "$name: $oneLine (see $name --help)"
    }

    /** The command whose options were being read. */
    private fun innermost(): Context =
        generateSequence(context) { it.invokedSubcommands.lastOrNull()?.currentContext }.last()

    private fun onOneLine(text: String) =
        text.lineSequence().map { it.trim() }.filter { it.isNotEmpty() }.joinToString(" ")

    internal companion object {
        /** The one of [options] that [typed] is likely meant to be, in a list; none where nothing is near. */
        fun suggestion(typed: String, options: List<String>): List<String> =
            listOfNotNull(NearName.of(typed, options.filter { it.startsWith(typed.takeWhile { c -> c == '-' }) }))
    }
}
