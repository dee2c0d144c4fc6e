package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.UsageError
import com.github.ajalt.clikt.parameters.options.NullableOption
import com.github.ajalt.clikt.parameters.options.RawOption
import com.github.ajalt.clikt.parameters.options.convert
import stillwater.io.DecimalText
import stillwater.io.JsonFileProblem

/** Exit code of a command that was given something it cannot use. */
const val BAD_INPUT = 2

/** A flag whose value cannot be used; one line, exit code [BAD_INPUT]. */
class BadFlag private constructor(message: String) : UsageError(message, statusCode = BAD_INPUT) {
    constructor(flag: String, expected: String, found: String) : this("$flag: expected $expected, found $found")

    /** The file that [flag] names is what is wrong. */
    constructor(flag: String, problem: JsonFileProblem) : this("$flag: ${problem.message}")

    /** This problem as one of the command that runs in [context], where Clikt does not know it yet. */
    fun of(context: Context): BadFlag = also { it.context = it.context ?: context }
}

/** A finite number for which [accepts] holds; [expected] says what that means. */
fun RawOption.number(expected: String, accepts: (Double) -> Boolean = { true }): NullableOption<Double, Double> =
    convert { text ->
        DecimalText.parse(text).takeIf { it.isFinite() && accepts(it) } ?: throw BadFlag(name, expected, "'$text'")
    }

/** A whole number for which [accepts] holds; [expected] says what that means. */
fun RawOption.wholeNumber(expected: String, accepts: (Int) -> Boolean): NullableOption<Int, Int> = convert { text ->
    text.toIntOrNull()?.takeIf(accepts) ?: throw BadFlag(name, expected, "'$text'")
}

/** A directory for results; an empty name, as of a variable that is not set, would be the working directory. */
fun RawOption.directory(): NullableOption<String, String> = convert { text ->
    text.ifBlank { throw BadFlag(name, "a directory (. for this one)", "'$text'") }
}

/** A unit of readings, as it is to be written. */
fun RawOption.unit(): NullableOption<String, String> = convert { text ->
    text.trim().ifEmpty { throw BadFlag(name, "a unit such as mg/L", "'$text'") }
}

/** Two finite numbers written with [separator] between them, the first below the second unless [anyOrder]. */
fun RawOption.numberPair(
    separator: Char,
    expected: String,
    accepts: (Double, Double) -> Boolean,
): NullableOption<Pair<Double, Double>, Pair<Double, Double>> = convert { text ->
    val numbers = text.split(separator).map { DecimalText.parse(it) }
    if (numbers.size != 2 || numbers.any { !it.isFinite() } || !accepts(numbers[0], numbers[1])) {
        throw BadFlag(name, expected, "'$text'")
    }
    numbers[0] to numbers[1]
}

/** One or more of [choices], separated by commas, each once. */
fun <T> RawOption.someOf(choices: Map<String, T>): NullableOption<List<T>, List<T>> = convert { text ->
    val expected = "some of ${choices.keys.joinToString(", ")}, separated by commas"
    val chosen = text.split(',').map { choices[it.trim()] ?: throw BadFlag(name, expected, "'$text'") }
    if (chosen.distinct().size != chosen.size) throw BadFlag(name, "$expected, each once", "'$text'")
    chosen
}

/** One of [choices], which [expected] names in an error. */
fun <T : Any> RawOption.oneOf(
    choices: Map<String, T>,
    expected: String = "one of ${choices.keys.joinToString(", ")}",
): NullableOption<T, T> = convert { text -> choices[text] ?: throw BadFlag(name, expected, "'$text'") }
