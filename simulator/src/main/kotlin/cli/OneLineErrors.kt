package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.MultiUsageError
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.output.HelpFormatter
import com.github.ajalt.clikt.output.MordantHelpFormatter

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
        return "$programName: $oneLine (see $programName --help)"
    }

    private fun onOneLine(text: String) =
        text.lineSequence().map { it.trim() }.filter { it.isNotEmpty() }.joinToString(" ")
}
