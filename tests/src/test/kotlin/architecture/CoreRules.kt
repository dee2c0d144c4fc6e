package stillwater.architecture

/** A place where core does what it must not. */
internal data class Violation(val path: String, val line: Int, val what: String) {
    override fun toString(): String = "$path:$line: $what"
}

/** Which packages of core each one is built on; what those are built on is allowed with them. */
private val arrows: Map<String, Set<String>> =
    mapOf(
        "model" to emptySet(),
        "sensor" to setOf("model"),
        "field" to setOf("model"),
        "wire" to setOf("model"),
        "control" to setOf("model"),
        "estimate" to setOf("sensor", "field"),
        "plan" to setOf("field"),
        "diagnose" to setOf("sensor", "estimate"),
        "virtual" to setOf("sensor", "field", "wire"),
        "mission" to setOf("model", "sensor", "field", "wire", "control", "estimate", "plan"),
    )

/** The same of the packages within diagnose, which all know what it is asked and answers with. */
private val diagnoseArrows: Map<String, Set<String>> =
    mapOf(
        "algebra" to emptySet(),
        "noise" to setOf("algebra"),
        "response" to setOf("noise"),
        "track" to setOf("response"),
        "water" to setOf("track"),
        "evidence" to setOf("response"),
        "reference" to setOf("evidence", "track"),
        "blind" to setOf("evidence", "water"),
    )

/** Files of diagnose itself that ask those packages; what all of these know of it may know of [BELOW_ALL] alone. */
private val facades = setOf("Diagnosis.kt", "ChannelLags.kt")
private const val BELOW_ALL = "algebra"

private val allowedImports =
    listOf("kotlin.", "kotlinx.serialization.", "org.hipparchus.") +
        // What the platform has and Kotlin's own library lacks; no state, no outside world.
        listOf("java.util.Arrays", "java.util.BitSet", "java.util.PriorityQueue", "java.util.Locale")

/** No file, socket, thread, wall clock, console or ambient randomness: pattern, and what it stands for. */
private val forbiddenCode: List<Pair<Regex, String>> =
    listOf(
        """\bjava\.(io|nio|net|time|sql)\b|\bkotlin\.io\.|\bjava\.util\.concurrent\b|\bkotlin\.concurrent\b""" to
            "files, sockets, threads and the wall clock are not core's",
        """\bThread\b|\bthread\s*[({]|\bThreadLocal\b|\bsynchronized\s*\(""" to "threads are not core's",
        """\bSystem\s*\.\s*\w+|\bkotlin\.system\b|\bmeasureTime\b|\bmeasureNanoTime\b|\bmeasureTimeMillis\b""" to
            "the machine and its clock are not core's: a Clock comes in through the constructor",
        """\bkotlin\.time\.Clock\b|\bTimeSource\b|\bClock\.System\b|\bInstant\.now\b""" to
            "the wall clock is not core's: a Clock comes in through the constructor",
        """\bRandom\s*\.\s*(Default|next\w+)|\bMath\s*\.\s*random\b|\bjava\.util\.Random\b|\bUUID\b""" to
            "ambient randomness: a Random comes in through the constructor",
        """\.\s*(random|randomOrNull|shuffle|shuffled)\s*\(\s*\)""" to
            "ambient randomness: hand the Random over",
        """(?<![\w.])(println|print|readln|readLine)\s*\(""" to "the console is not core's",
    ).map { (pattern, why) -> Regex(pattern) to why }

private val importLine = Regex("""(?m)^import ([\w.`]+)(?:\.\*)?""")
private val ownName = Regex("""\bstillwater\.(\w+)""")
private val diagnoseName = Regex("""\bstillwater\.diagnose\.([a-z]\w*)\.""")

/** All that a package of core may use of core, itself included; null where the rules do not know it. */
internal fun reachable(corePackage: String): Set<String>? = reachable(corePackage, arrows)

private fun reachable(start: String, arrows: Map<String, Set<String>>): Set<String>? {
    val direct = arrows[start] ?: return null
    return direct.fold(setOf(start)) { all, next -> all + reachable(next, arrows).orEmpty() }
}

/** What in a source of core is against core's rules. */
internal fun coreViolations(source: KotlinSource): List<Violation> =
    importsFromOutside(source) + wrongArrows(source) + wrongWithinDiagnose(source) + forbidden(source)

private fun importsFromOutside(source: KotlinSource): List<Violation> =
    importLine
        .findAll(source.code)
        .filter { match ->
            (allowedImports + "stillwater.").none { "${match.groupValues[1]}.".startsWith(it.suffixed()) }
        }.map { Violation(source.path, source.lineOf(it.range.first), "core may not import ${it.groupValues[1]}") }
        .toList()

private fun String.suffixed(): String = if (endsWith(".")) this else "$this."

/** Imports and qualified names alike: an arrow is an arrow. */
private fun wrongArrows(source: KotlinSource): List<Violation> {
    val from = source.directory.substringBefore('/')
    val allowed =
        reachable(from)
            ?: return listOf(Violation(source.path, 1, "core has no package $from in the rules of CoreRules.kt"))
    return ownName
        .findAll(source.code)
        .filter { it.groupValues[1] !in allowed }
        .map { Violation(source.path, source.lineOf(it.range.first), "$from may not use ${it.groupValues[1]}") }
        .toList()
}

private fun wrongWithinDiagnose(source: KotlinSource): List<Violation> {
    val isRoot = source.directory == "diagnose"
    val isFacade = isRoot && source.path.substringAfterLast('/') in facades
    if (isFacade || source.directory.substringBefore('/') != "diagnose") return emptyList()
    val from = source.directory.removePrefix("diagnose/")
    val allowed =
        (if (isRoot) setOf(BELOW_ALL) else reachable(from, diagnoseArrows))
            ?: return listOf(Violation(source.path, 1, "diagnose has no package $from in the rules of CoreRules.kt"))
    return diagnoseName
        .findAll(source.code)
        .filter { it.groupValues[1] !in allowed }
        .map { Violation(source.path, source.lineOf(it.range.first), "$from may not use ${it.groupValues[1]}") }
        .toList()
}

private fun forbidden(source: KotlinSource): List<Violation> =
    forbiddenCode.flatMap { (pattern, why) ->
        pattern
            .findAll(source.code)
            .map { Violation(source.path, source.lineOf(it.range.first), "${it.value.trim()}: $why") }
            .toList()
    }
