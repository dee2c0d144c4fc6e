package gradlecheck

import org.gradle.api.tasks.wrapper.Wrapper
import org.gradle.testfixtures.ProjectBuilder
import java.io.File

/** Writes gradlew, gradlew.bat and gradle/wrapper with Gradle's own task: repository root, Gradle version, SHA-256. */
fun main(arguments: Array<String>) {
    val (root, version, sha256) = arguments
    val scratch = scratchDirectory()
    val project =
        ProjectBuilder
            .builder()
            .withProjectDir(File(root).canonicalFile)
            .withGradleUserHomeDir(scratch)
            .build()
    // Offline, the task takes the distribution's address as it is instead of asking for it; the checksum holds it.
    project.gradle.startParameter.isOffline = true
    project.pluginManager.apply("wrapper")
    val wrapper = project.tasks.named("wrapper", Wrapper::class.java).get()
    wrapper.gradleVersion = version
    wrapper.distributionType = Wrapper.DistributionType.BIN
    wrapper.distributionSha256Sum = sha256
    wrapper.actions.forEach { it.execute(wrapper) }
    scratch.deleteRecursively()
}
