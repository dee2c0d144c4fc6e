package stillwater.app.service

import android.os.Binder

/** What Android hands to the screens of this process: the [boat] itself. */
open class BoatBinder(val boat: BoatCommands) : Binder()
