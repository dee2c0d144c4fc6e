package stillwater.cli

/** Ends a line in a help text, which is wrapped otherwise. */
private const val LINE_BREAK = "\u0085"

/** The end of a command's help: what it writes, in [text], and [examples] of its use, a line each. */
fun helpEnd(text: String, examples: List<String>): String =
    text + "\n\nExamples:" + examples.joinToString("") { "$LINE_BREAK$it" }
