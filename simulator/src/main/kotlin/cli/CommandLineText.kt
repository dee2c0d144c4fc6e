package stillwater.cli

/** A command as it would be typed: [command], its [argument] if it has one, and the flags that were given; null and false are not. */
fun commandLineText(command: String, argument: String?, flags: List<Pair<String, Any?>>): String {
    val parts = ArrayList<String>()
    for ((flag, value) in flags) {
        when (value) {
            null, false -> Unit
            true -> parts += flag
            else -> parts += "$flag ${typed(value.toString())}"
        }
    }
    return (listOfNotNull(command, argument?.let(::typed)) + parts).joinToString(" ")
}

/** [text] in quotes where a shell would take it apart. */
private fun typed(text: String) =
    if (text.all { it.isLetterOrDigit() || it in "-_./:=,#+%" }) text else "'" + text.replace("'", "'\\''") + "'"
