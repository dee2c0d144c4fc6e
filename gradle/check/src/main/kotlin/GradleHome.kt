package gradlecheck

import java.io.File
import kotlin.io.path.createTempDirectory

/** A Gradle home for one run, so that nothing is left in the user's. */
internal fun scratchDirectory(): File = createTempDirectory("gradle-check").toFile()
