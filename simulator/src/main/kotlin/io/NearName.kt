package stillwater.io

/** Finds what somebody meant who wrote a name that is none. */
internal object NearName {
    /** The one of [names] that is nearest to [wrong], if any is near. */
    fun of(wrong: String, names: List<String>): String? {
        val bare = bare(wrong)
        if (bare.isEmpty()) return null
        names.firstOrNull { bare(it) == bare }?.let { return it }
        // Of a name that is wrong in every letter nothing is near.
        val near = minOf(maxOf(1, bare.length / LETTERS_A_MISTAKE), bare.length - 1)
        names.map { it to distance(bare, bare(it)) }.minByOrNull { it.second }
            ?.let { (name, distance) -> if (distance <= near) return name }
        return names.filter { bare.length >= LETTERS_A_MISTAKE && bare in bare(it) }.singleOrNull()
    }

    /** [text] without what people leave out: capitals, blanks, marks. */
    private fun bare(text: String) = text.lowercase().filter { it.isLetterOrDigit() }

    /** Letters to put in, take out or change to make [b] of [a] (Levenshtein 1966). */
    private fun distance(a: String, b: String): Int {
        var above = IntArray(b.length + 1) { it }
        for (i in a.indices) {
            val row = IntArray(b.length + 1)
            row[0] = i + 1
            for (j in b.indices) {
                val changed = above[j] + if (a[i] == b[j]) 0 else 1
                row[j + 1] = minOf(changed, above[j + 1] + 1, row[j] + 1)
            }
            above = row
        }
        return above[b.length]
    }

    private const val LETTERS_A_MISTAKE = 3
}
