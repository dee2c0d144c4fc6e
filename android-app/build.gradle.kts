// Needs the Android SDK. Maven builds the same app without it, see pom.xml here.
plugins {
    alias(libs.plugins.android.application)
}

android {
    namespace = "stillwater.app"
    compileSdk = 35
    defaultConfig {
        applicationId = "stillwater.app"
        minSdk = 26
        targetSdk = 35
        versionCode = 1
        versionName = project.version.toString()
    }
    compileOptions {
        sourceCompatibility = JavaVersion.VERSION_17
        targetCompatibility = JavaVersion.VERSION_17
    }
    testOptions {
        unitTests { isIncludeAndroidResources = true }
    }
}

dependencies {
    implementation(project(":core"))
    implementation(libs.usb.serial)

    testImplementation(libs.robolectric)
    testImplementation(libs.junit4)
    testImplementation(libs.junit.vintage)
    testImplementation(libs.junit.jupiter)
    testImplementation(libs.kotlin.test)
    testRuntimeOnly(libs.junit.launcher)
}
