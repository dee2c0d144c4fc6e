package stillwater.estimate

/**
 * How far what a lag follows is ahead of what the lag shows, sensor units, from the states of a [FieldMotion]: above 0
 * while the lag rises, below 0 while it falls.
 *
 * @param size number of states. @param followed the state that the lag follows. @param lag the lag's own state.
 */
internal class LagLead(private val size: Int, private val followed: Int, private val lag: Int) {
    /** Its mean where the states' are [x], length [size]. Not modified. */
    fun mean(x: DoubleArray): Double = x[followed] - x[lag]

    /** Its covariances with the states, of covariance [p] (row-major, not modified), into [rows] from [from] on. */
    fun covariances(p: DoubleArray, rows: DoubleArray, from: Int) {
        for (j in 0 until size) rows[from + j] = p[followed * size + j] - p[lag * size + j]
    }

    /** Its variance, from its [covariances] in [rows] from [from] on. Not modified. */
    fun variance(rows: DoubleArray, from: Int): Double = rows[from + followed] - rows[from + lag]

    companion object {
        /**
         * That of the first lag of [response] that rises and falls unlike, of [size] states of which the first [water]
         * are the field's; null where none does, or where a limit tells which way the sensor goes.
         */
        fun of(response: Response, water: Int, size: Int): LagLead? {
            if (!isAskedOf(response)) return null
            val k = response.lags.indexOfFirst { it.rising != it.falling }
            return LagLead(size, if (k == 0) 0 else water + k - 1, water + k)
        }

        /** Whether one tells of [response] which way its lags go. */
        fun isAskedOf(response: Response): Boolean =
            response.lags.any { it.rising != it.falling } && !response.slewRate.isFinite() && response.slowShare <= 0
    }
}
