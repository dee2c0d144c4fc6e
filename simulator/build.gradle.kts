plugins {
    alias(libs.plugins.kotlin.jvm)
    alias(libs.plugins.kotlin.serialization)
    application
}

kotlin {
    jvmToolchain(17)
}

application {
    applicationName = "stillwater"
    mainClass.set("stillwater.cli.MainKt")
}

dependencies {
    api(project(":core"))
    api(libs.kotlinx.coroutines.core)
    api(libs.kotlinx.serialization.json)
    api(libs.kotlinx.html)
    api(libs.hipparchus.stat)
    api(libs.clikt)
    api(libs.mordant)
    api(libs.fastcsv)
    api(libs.lets.plot.kotlin)
    api(libs.lets.plot.awt)
    api(libs.jsvg)
    api(libs.jserialcomm)
    api(libs.jna)
    runtimeOnly(libs.slf4j.nop)

    testImplementation(libs.junit.jupiter)
    testImplementation(libs.kotlin.test)
    testRuntimeOnly(libs.junit.launcher)
}
