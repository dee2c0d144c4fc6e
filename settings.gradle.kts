pluginManagement {
    repositories {
        google()
        gradlePluginPortal()
        mavenCentral()
    }
}

dependencyResolutionManagement {
    repositoriesMode.set(RepositoriesMode.FAIL_ON_PROJECT_REPOS)
    repositories {
        mavenCentral()
        google()
        // usb-serial-for-android is on JitPack only: -PusbSerialRepository=<JitPack's address>, see CONTRIBUTING.md.
        providers.gradleProperty("usbSerialRepository").orNull?.let { address ->
            maven {
                setUrl(address)
                content { includeGroup("com.github.mik3y") }
            }
        }
    }
}

rootProject.name = "stillwater"

include(":core", ":simulator", ":tests")

// The app needs the Android SDK; the rest builds without.
if (System.getenv("ANDROID_HOME") != null || rootDir.resolve("local.properties").exists()) include(":android-app")
