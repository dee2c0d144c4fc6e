/**
 * Stand-ins for what Gradle's script compiler provides and its published API does not hold: the extensions of the
 * Kotlin DSL and the accessors it generates for applied plug-ins. Signatures only; nothing here is ever run. Every
 * other name in a script is resolved against the Gradle API and the Kotlin plug-in's API themselves.
 */
package gradlecheck.dsl

import com.android.build.api.dsl.ApplicationExtension
import org.gradle.api.Project
import org.gradle.api.artifacts.Dependency
import org.gradle.api.artifacts.dsl.DependencyHandler
import org.gradle.api.plugins.JavaApplication
import org.gradle.api.tasks.TaskCollection
import org.gradle.plugin.use.PluginDependenciesSpec
import org.gradle.plugin.use.PluginDependencySpec
import org.jetbrains.kotlin.gradle.dsl.KotlinJvmExtension

private fun neverRun(): Nothing = error("compiled, never run")

public fun Project.plugins(block: PluginDependenciesSpec.() -> Unit): Unit = neverRun()

public infix fun PluginDependencySpec.apply(apply: Boolean): PluginDependencySpec = apply(apply)

public val PluginDependenciesSpec.application: PluginDependencySpec get() = neverRun()

public fun Project.kotlin(block: KotlinJvmExtension.() -> Unit): Unit = neverRun()

public fun Project.android(block: ApplicationExtension.() -> Unit): Unit = neverRun()

public fun Project.application(block: JavaApplication.() -> Unit): Unit = neverRun()

public class DependencyHandlerScope(
    handler: DependencyHandler,
) : DependencyHandler by handler

public fun Project.dependencies(block: DependencyHandlerScope.() -> Unit): Unit = neverRun()

public fun DependencyHandler.api(notation: Any): Dependency? = neverRun()

public fun DependencyHandler.implementation(notation: Any): Dependency? = neverRun()

public fun DependencyHandler.runtimeOnly(notation: Any): Dependency? = neverRun()

public fun DependencyHandler.testImplementation(notation: Any): Dependency? = neverRun()

public fun DependencyHandler.testRuntimeOnly(notation: Any): Dependency? = neverRun()

public fun DependencyHandler.project(path: String): Dependency = neverRun()

public inline fun <reified T : org.gradle.api.Task> TaskCollection<in T>.withType(): TaskCollection<T> = error(
    "compiled, never run",
)
