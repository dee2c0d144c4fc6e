package stillwater.diagnosis

import stillwater.diagnose.Loops
import java.util.stream.IntStream

/** On all cores. What is done once needs none but its own. */
internal val AT_ONCE = Loops { count, task ->
    if (count == 1) task(0) else IntStream.range(0, count).parallel().forEach(task)
}
