package stillwater.io

/** A column `twice`: twice the value of each reading of [log]. */
internal fun twice(log: SurveyLog): AddedColumns {
    val readings = log.readings()
    fun of(number: (Int) -> Double) = DoubleArray(readings.size, number)
    return AddedColumns(
        log,
        listOf("twice"),
        of { readings[it].time.seconds },
        of { readings[it].position.x },
        of { readings[it].position.y },
        of { readings[it].value },
    ) { k -> listOf((2 * readings[k].value).toString()) }
}
