package stillwater.survey

import stillwater.model.Conditions

/**
 * What is found out about a log before filters can run: what it looks like, and how far its slopes are noise. It keeps
 * the readings.
 *
 * Confined to one thread at a time.
 *
 * @param settings what is asked for.
 */
internal class FirstLook(settings: MapSettings) {
    val scan = SurveyScan()
    val kept = KeptReadings()
    val epsilon = EpsilonSearch(settings)

    /** Takes the next readings, which are not added to any more. */
    fun take(block: ReadingBlock) {
        kept.take(block)
        block.read { time, x, y, value, _ ->
            scan.take(time, x, y, value, Conditions.NONE)
            epsilon.add(time.seconds, value)
        }
    }
}
