package stillwater.report

/** [count] things in words: `1 reading`, `2 readings`; [several] where the plural is not just an s more. */
internal fun counted(count: Long, one: String, several: String = one + "s"): String =
    if (count == 1L) "1 $one" else "$count $several"

/** As for a Long. */
internal fun counted(count: Int, one: String, several: String = one + "s"): String =
    counted(count.toLong(), one, several)
