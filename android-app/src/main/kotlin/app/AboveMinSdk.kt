package stillwater.app

/**
 * Marks a function that calls what the oldest supported Android does not have, behind a look at the version.
 *
 * The build's API-level gate passes over what bears it; everything else is held to minSdk.
 */
@Retention(AnnotationRetention.BINARY)
@Target(AnnotationTarget.FUNCTION, AnnotationTarget.CLASS)
internal annotation class AboveMinSdk
