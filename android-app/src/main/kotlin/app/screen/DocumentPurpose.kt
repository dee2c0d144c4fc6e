package stillwater.app.screen

/** What a chosen document is for; its place in the list is the number that Android gives back. */
internal enum class DocumentPurpose {
    /** A mission to read. */
    MISSION,

    /** A probe, or a sensor that was diagnosed, to read. */
    PROBE,

    /** Where to write the mission that was filled in. */
    SAVED_MISSION,

    /** Where to write the log of a past mission. */
    LOG,

    /** Where to write a past mission's map as CSV. */
    CSV,

    /** Where to write a past mission's map as GeoJSON. */
    GEOJSON,
}
