package stillwater.diagnose.track

import java.util.Locale
import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.hypot

/** How much of a track comes near another pass of itself: without that nothing but smoothness tells water from sensor. */
internal object Passes {
    /** Parts of a wave that is near. */
    const val NEAR = 2.0
    private const val APART = 2.0

    /**
     * The share of the places ([x], [y]), m, in the order they were passed, that have another one within half of
     * [wave], m, which is more than two such waves away along the way.
     */
    fun share(x: DoubleArray, y: DoubleArray, wave: Double): Double {
        val reach = wave / NEAR
        val way = DoubleArray(x.size)
        for (i in 1 until x.size) way[i] = way[i - 1] + hypot(x[i] - x[i - 1], y[i] - y[i - 1])
        val cells = HashMap<Pair<Long, Long>, ArrayList<Int>>()
        fun cell(at: Double) = floor(at / reach).toLong()
        for (i in x.indices) cells.getOrPut(cell(x[i]) to cell(y[i])) { ArrayList() } += i

        fun isNear(i: Int, k: Int) =
            abs(way[i] - way[k]) > APART * wave && hypot(x[i] - x[k], y[i] - y[k]) < reach
        val near = x.indices.count { i ->
            val column = cell(x[i])
            val row = cell(y[i])
            (column - 1..column + 1).any { a ->
                (row - 1..row + 1).any { b -> cells[a to b].orEmpty().any { isNear(i, it) } }
            }
        }
        return near.toDouble() / x.size
    }

    /** Why a [share] of the rows, of which [least] is enough, within [near] [unit] of another pass shows nothing. */
    fun tooFew(share: Double, least: Double, near: String, unit: String): String {
        fun percent(part: Double) = "%.2g".format(Locale.ROOT, 100 * part)
        return if (share == 0.0) {
            "no pass comes within $near $unit of another, so that nothing tells the water's own changes from what " +
                "the sensor makes of them"
        } else {
            "only ${percent(share)} % of the rows come within $near $unit of another pass, where ${percent(least)} % " +
                "are needed to tell the water's own changes from what the sensor makes of them"
        }
    }
}
