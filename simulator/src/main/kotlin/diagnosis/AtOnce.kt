package stillwater.diagnosis

import stillwater.diagnose.Loops
import java.util.stream.IntStream

/** On all cores. */
internal val AT_ONCE = Loops { count, task -> IntStream.range(0, count).parallel().forEach(task) }
