package stillwater.apk

import org.junit.jupiter.api.Assumptions.assumeFalse
import java.io.File
import kotlin.test.fail

/** What other modules' builds leave behind; `mvn verify` has all of it by the time these tests run. */
internal object Built {
    private val root =
        generateSequence(File("").absoluteFile) { it.parentFile }.first { it.resolve("settings.gradle.kts").isFile }

    /** The app's module. */
    val app: File = root.resolve("android-app")

    /**
     * [file], where it is there. Its absence fails the test, so that no build passes without having looked; who works
     * on something else says `-Dstillwater.unbuilt=skip`, and sees the test skipped.
     *
     * @param how it is made.
     */
    fun existing(file: File, how: String): File {
        if (file.exists()) return file
        val words = "$file is missing: $how makes it. To leave it out: -D$SKIPPED=skip"
        assumeFalse(System.getProperty(SKIPPED) == "skip", words)
        fail(words)
    }

    private const val SKIPPED = "stillwater.unbuilt"
}
