package stillwater.plot

/** Data that can be drawn as one [Figure]. Drawing is pure: it reads nothing but the data. */
public fun interface Drawing {
    /** Draws the data; never fails on values (NaN, infinite and missing ones are left out). */
    public fun draw(): Figure
}

/**
 * Draws several figures at once, on up to all cores, in the order given.
 *
 * @param png whether to make each figure's PNG too, so that a later [Figure.png] costs nothing.
 * @throws FigureException as [Figure.png], if [png] is asked for.
 */
public fun List<Drawing>.drawAll(png: Boolean = false): List<Figure> =
    parallelStream().map { it.draw().also { figure -> if (png) figure.png() } }.toList()
