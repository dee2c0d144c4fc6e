package stillwater.app.link

/** Where a link stands. */
enum class LinkState {
    /** Not asked to connect. */
    CLOSED,

    /** The first attempt is under way, or the next one. */
    CONNECTING,

    /** Bytes can go both ways. */
    CONNECTED,

    /** Lost or refused; waiting before the next attempt. */
    WAITING,
}

/**
 * What a link went through since it was opened; the link screen shows all of it.
 *
 * @property connects times a connection came about.
 * @property drops times a connection that had come about was lost.
 * @property failures times one did not come about.
 * @property bytesIn received, those of [bytesOverrun] among them.
 * @property bytesOut sent.
 * @property bytesOverrun received and dropped, because nobody had read for too long.
 * @property writesDropped commands not sent: no connection, or a newer one took their place.
 * @property writesHung times a connection was given up because one command did not go out.
 * @property quietMillis time since the last byte came or the connection did, ms; null while not connected.
 * @property lastError why the last connection ended or did not come about, in words; null if none did.
 */
data class LinkHealth(
    val state: LinkState = LinkState.CLOSED,
    val connects: Long = 0,
    val drops: Long = 0,
    val failures: Long = 0,
    val bytesIn: Long = 0,
    val bytesOut: Long = 0,
    val bytesOverrun: Long = 0,
    val writesDropped: Long = 0,
    val writesHung: Long = 0,
    val quietMillis: Long? = null,
    val lastError: String? = null,
)
