package stillwater.model

import kotlinx.serialization.DeserializationStrategy
import kotlinx.serialization.ExperimentalSerializationApi
import kotlinx.serialization.SerializationException
import kotlinx.serialization.descriptors.PolymorphicKind
import kotlinx.serialization.descriptors.PrimitiveKind
import kotlinx.serialization.descriptors.SerialDescriptor
import kotlinx.serialization.descriptors.SerialKind
import kotlinx.serialization.descriptors.StructureKind
import kotlinx.serialization.descriptors.elementDescriptors
import kotlinx.serialization.descriptors.elementNames
import kotlinx.serialization.json.Json

/**
 * A form of JSON texts that people write: whatever is wrong with one is said with line, column, field, what was expected
 * and what was found.
 *
 * Stricter than the library that reads it: a field that is there twice is refused, since one of the two would be passed
 * over; so are numbers in quotes. A byte order mark at the begin is passed over.
 *
 * @param what a text is, with its article, such as `a mission`.
 */
public class JsonForm<T>(private val serializer: DeserializationStrategy<T>, private val what: String) {
    /**
     * What [json] says.
     *
     * @throws JsonProblem if it is not of this form, or what it says is refused by whoever is built of it.
     */
    public fun read(json: String): T {
        val text = json.removePrefix(BYTE_ORDER_MARK)
        val walk = Walk(JsonScanner(text), JsonPlace(text))
        try {
            walk.value(serializer.descriptor, "")
            walk.scanner.end()
        } catch (fault: JsonScanner.Fault) {
            val words = "expected ${fault.expected}, found ${fault.found}"
            throw problem(text, fault.offset, walk.field, words, fault)
        }
        try {
            return Json.decodeFromString(serializer, text)
        } catch (refused: IllegalArgumentException) {
            throw rule(text, refused)
        }
    }

    /** That the value at [path] of [json], such as `$.features[0].geometry`, is not what it should be: [words]. */
    public fun problem(json: String, path: String, words: String): JsonProblem {
        val text = json.removePrefix(BYTE_ORDER_MARK)
        return problem(text, JsonPlace(text).of(path), path.removePrefix("$").removePrefix("."), words, null)
    }

    private fun problem(text: String, offset: Int, field: String, words: String, cause: Throwable?): JsonProblem {
        val at = if (field.isEmpty()) "" else "$field: "
        // A name or text that is quoted may hold anything.
        val line = (at + words).map { if (it.isISOControl()) ' ' else it }.joinToString("")
        return JsonProblem(what, JsonPlace(text).lineAndColumn(offset), line, cause)
    }

    /** What was built of the text refused it. Its message has the name of the value, which is where to look. */
    private fun rule(text: String, refused: IllegalArgumentException): JsonProblem {
        val path = PATH.find(refused.message.orEmpty())?.groupValues?.get(1) ?: "$"
        val own = generateSequence<Throwable>(refused) { it.cause }
            .firstOrNull { it is IllegalArgumentException && it !is SerializationException } ?: refused
        val words = own.message.orEmpty().lineSequence().first()
        val place = JsonPlace(text)
        val members = place.members(path)
        val named = WORD.findAll(words).firstNotNullOfOrNull { word ->
            val name = word.value.replace('-', '_').replace(CAPITAL) { "_" + it.value.lowercase() }
            members.entries.find { it.key == name || it.key.startsWith(name + "_") || it.key == name + "s" }
        }
        val field = path.removePrefix("$").removePrefix(".")
        return problem(text, named?.value ?: place.of(path), field, inWords(words, members.keys), refused)
    }

    /** [words] with the names that the text has, of its [members] where it has them, in place of the program's own. */
    private fun inWords(words: String, members: Set<String>) = OWN_NAME.replace(words) { match ->
        val name = match.value.replace(CAPITAL) { "_" + it.value.lowercase() }
        members.find { it == name || it.startsWith(name + "_") } ?: name
    }

    /** Goes through a text and what is expected of it at once. */
    @OptIn(ExperimentalSerializationApi::class)
    private class Walk(val scanner: JsonScanner, private val places: JsonPlace) {
        /** Path of the value that is looked at. */
        var field = ""
            private set

        fun value(form: SerialDescriptor, path: String) {
            field = path
            if (form.isNullable && scanner.word() == "null") {
                scanner.at += NULL_LENGTH
                return
            }
            when (form.kind) {
                StructureKind.CLASS, StructureKind.OBJECT -> fields(
                    form,
                    path,
                    "an object in braces with " + names(form),
                )
                PolymorphicKind.SEALED -> if (form.serialName == ANY) scanner.any() else typed(form, path)
                StructureKind.LIST -> scanner.items("a list in brackets") { index ->
                    value(form.getElementDescriptor(0), "$path[$index]")
                    field = path
                }
                SerialKind.ENUM -> choice(form.elementNames.toList(), "one of ")
                PrimitiveKind.INT -> numeric("a whole number") { it.toIntOrNull() != null }
                PrimitiveKind.LONG -> numeric("a whole number") { it.toLongOrNull() != null }
                PrimitiveKind.DOUBLE -> numeric("a number") { it.toDouble().isFinite() }
                PrimitiveKind.BOOLEAN -> {
                    val word = scanner.word()
                    if (word != "true" && word != "false") scanner.fail("true or false")
                    scanner.at += word.length
                }
                PrimitiveKind.STRING -> scanner.string("a text in quotes")
                else -> scanner.any()
            }
        }

        private fun fields(form: SerialDescriptor, path: String, expected: String, type: String? = null) {
            scanner.next()
            val begin = scanner.at
            val missing = LinkedHashSet((0 until form.elementsCount).filterNot(form::isElementOptional))
            scanner.members(expected) { name, offset ->
                val index = form.getElementIndex(name)
                if (name == type) {
                    scanner.any()
                } else if (index < 0) {
                    throw JsonScanner.Fault(offset, "one of " + names(form), "'$name'")
                } else {
                    missing -= index
                    value(form.getElementDescriptor(index), if (path.isEmpty()) name else "$path.$name")
                    field = path
                }
            }
            if (missing.isEmpty()) return
            val names = missing.joinToString(", ") { form.getElementName(it) }
            throw JsonScanner.Fault(begin, "the field${if (missing.size > 1) "s" else ""} $names", "none")
        }

        /** An object whose field `type` says which of several forms it has. */
        private fun typed(form: SerialDescriptor, path: String) {
            // A sealed type's descriptor: the name of the field, and the forms by their names.
            val field = form.getElementName(0)
            val forms = form.getElementDescriptor(1).elementDescriptors.associateBy { it.serialName }
            scanner.next()
            val begin = scanner.at
            val offset = places.members("$.$path")[field] ?: -1
            if (offset < 0) {
                scanner.members("an object in braces with $field") { _, _ -> scanner.any() }
                throw JsonScanner.Fault(begin, "the field $field, one of " + forms.keys.sorted().joinToString(), "none")
            }
            scanner.at = offset
            this.field = "$path.$field"
            val chosen = forms.getValue(choice(forms.keys.sorted(), "one of "))
            this.field = path
            scanner.at = begin
            fields(chosen, path, "", field)
        }

        private fun choice(names: List<String>, expected: String): String {
            scanner.next()
            val begin = scanner.at
            val wanted = expected + names.joinToString()
            val name = scanner.string(wanted)
            if (name !in names) throw JsonScanner.Fault(begin, wanted, "'$name'")
            return name
        }

        private fun numeric(expected: String, isGood: (String) -> Boolean) {
            scanner.next()
            val begin = scanner.at
            val written = scanner.number(expected)
            if (!isGood(written)) throw JsonScanner.Fault(begin, expected, "'$written'")
        }

        private fun names(form: SerialDescriptor) = form.elementNames.joinToString()
    }

    public companion object {
        private const val BYTE_ORDER_MARK = "\uFEFF"
        private const val ANY = "kotlinx.serialization.json.JsonElement"
        private const val NULL_LENGTH = 4
        private val PATH = Regex("""at path:? (\$\S*)""")
        private val WORD = Regex("""[A-Za-z][A-Za-z_-]*""")
        private val CAPITAL = Regex("[A-Z]")

        /** A name as the program writes it, `timeConstant`, which no word of a sentence looks like. */
        private val OWN_NAME = Regex("""\b[a-z]+(?:[A-Z][a-z]+)+\b""")

        /**
         * Whether [text] can be parsed without fear for the stack: at most [JsonScanner.DEEPEST] brackets one within the
         * other, strings passed over. O(length), no allocation.
         */
        public fun isShallow(text: CharSequence, start: Int = 0): Boolean {
            var depth = 0
            var isInString = false
            var at = start
            while (at < text.length) {
                when (text[at]) {
                    '"' -> isInString = !isInString
                    '\\' -> if (isInString) at++
                    '{', '[' -> if (!isInString && ++depth > JsonScanner.DEEPEST) return false
                    '}', ']' -> if (!isInString) depth--
                }
                at++
            }
            return true
        }
    }
}
