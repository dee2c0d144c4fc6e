package stillwater.diagnose.blind

/**
 * Something that readings may depend on though no cause of the list would make them.
 *
 * @property name in words. @property columns of readings that it would add, each as long as the log. @property follow
 *   how they change where what the model shows changes by so much; null where they are not made of it. @property searched
 *   what looking around for it has gained by chance. @property floor what its ratio is divided by at least, where a model
 *   leaves these whitened residuals. @property ofWater whether [columns] are what else the sensor might show of the
 *   water. @property isLoose whether a sum of [columns] may show the water smoother than it is, which suits any log.
 *   @property ofBoat whether [columns] are the boat's: the water knows nothing of them. @property ofTime whether they go
 *   with time alone, as noise does that wanders otherwise than its model. @property doubt how many times too small its
 *   p-value may be.
 */
internal class BlindLook(
    val name: String,
    val columns: List<DoubleArray>,
    val searched: Double = 0.0,
    val floor: (BlindState, DoubleArray) -> Double = { _, _ -> 1.0 },
    val ofWater: Boolean = false,
    val isLoose: Boolean = false,
    val ofBoat: Boolean = false,
    val ofTime: Boolean = false,
    val doubt: Double = DOUBT,
    val follow: ((DoubleArray) -> List<DoubleArray>)? = null,
) {
    companion object {
        /** How many times too small a look's p-value may be, where fixes jitter in steep water. */
        const val DOUBT = 10.0

        /**
         * The same of what the readings show more of at some times than at others, as if the water had changed: of 248
         * simulated logs without an effect five had one below 1 % otherwise (seeds 202000 to 215069).
         */
        const val DOUBT_OF_CHANGE = 1e4
    }
}
