package stillwater.plot

/** Data that can be drawn as one [Figure]. Drawing is pure: it reads nothing but the data. */
public fun interface Drawing {
    /** Draws the data; never fails on values (NaN, infinite and missing ones are left out). */
    public fun draw(): Figure
}

/** Draws several figures and their PNGs at once, on up to all cores, in the order given. */
public fun List<Drawing>.drawAll(): List<Figure> = drawConcurrently(map { drawing -> drawing::draw }) { it }

/**
 * The same for what [draw] gives, of which [figure] is the figure. Missing fonts show when a PNG is asked for.
 *
 * @param beside what else is to be done at once with them; begun first, and done when this returns.
 */
public fun <T : Any> drawConcurrently(
    draw: List<() -> T>,
    beside: List<() -> Unit> = emptyList(),
    figure: (T) -> Figure,
): List<T> {
    val drawn = ArrayList<T?>(draw.map { null })
    atOnce(beside + draw.indices.map { i -> { drawn[i] = draw[i]().also { figure(it).prepare() } } })
    return drawn.map { checkNotNull(it) }
}
