// Loaded once here, so that the modules share one Kotlin plug-in.
plugins {
    alias(libs.plugins.android.application) apply false
    alias(libs.plugins.kotlin.jvm) apply false
    alias(libs.plugins.kotlin.serialization) apply false
}

// As in the Maven build: the same on every machine, whatever its language and display.
subprojects {
    tasks.withType<Test>().configureEach {
        useJUnitPlatform { if (!project.hasProperty("long")) excludeTags("long") }
        systemProperty("java.awt.headless", "true")
        systemProperty("user.language", "en")
        systemProperty("user.country", "US")
    }
}
