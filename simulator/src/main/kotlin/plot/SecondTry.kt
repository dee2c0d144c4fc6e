package stillwater.plot

/**
 * Draws what failed within the plot library once more, with no other second try beside it.
 *
 * The library is not wholly safe on several threads: a test run had one figure fail with "Internal error: NullPointerException",
 * and the same input none again (nor 4140 other figures, drawn nine at once). A figure is a function of its input, so that a
 * second try draws what the first would have; what is wrong with the input fails again.
 */
internal object SecondTry {
    /** What [draw] gives; what it throws the first time, with the second time's suppressed, where it fails twice. */
    fun <T> of(draw: () -> T): T = runCatching(draw).getOrElse { first ->
        synchronized(this) { runCatching(draw).getOrElse { second -> throw first.apply { addSuppressed(second) } } }
    }
}
