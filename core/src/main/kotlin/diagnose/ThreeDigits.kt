package stillwater.diagnose

import java.util.Locale

/** [value] with three significant digits. */
internal fun three(value: Double): String = "%.3g".format(Locale.ROOT, value)
