package stillwater.app.service

import android.os.Build

/**
 * What Android makes of a service that wants positions and was not started by an app in sight, as after the process
 * died: with the location permission "while in use" they are its only as long as somebody began it from a window.
 *
 * Up to Android 10 the foreground with its type `location` is enough. From 11 to 13 the service is let into the
 * foreground, nothing is said, and no position ever comes. From 14 on it is refused by an exception.
 *
 * Source: Android's documentation, "Restrictions on starting a foreground service from the background"; AOSP change
 * c83a949722d0, which says when it is looked at: when the service is started or bound.
 */
internal object BackgroundPlace {
    /** Whether positions are kept back without a word. */
    val isKeptBackInSilence: Boolean
        get() = Build.VERSION.SDK_INT in Build.VERSION_CODES.R..Build.VERSION_CODES.TIRAMISU
}
