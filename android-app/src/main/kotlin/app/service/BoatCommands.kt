package stillwater.app.service

/**
 * What a screen may ask of the boat. Nothing waits: what came of it is in the next snapshots, a refusal as their answer.
 *
 * A link is chosen by starting the service, `BoatService.startIntent`, for Android wants it so; the demo is one of the
 * choices.
 */
interface BoatCommands {
    /** What the screens show; any thread. */
    val snapshot: BoatSnapshot

    /** Takes the mission in [json] in place of the one that is loaded, unless that one is under way. */
    fun load(json: String)

    /** Has the board armed, and the boat wait with its motors at rest. Only with a green checklist. */
    fun arm()

    /** Goes on the survey; arms first where that was not done. Also ends a hold or a return. */
    fun start()

    /** Stays on the spot, under power. */
    fun hold()

    /** Goes home, and ends the mission there. */
    fun goHome()

    /** Rests the motors, disarms, ends the mission and closes its log. The link stays. */
    fun stop()

    /**
     * Loads the mission whose log, cut off, is [name], with its map, unless one is under way. Others stay as they are.
     */
    fun goOnWith(name: String)

    /** Forgets the mission that is loaded, unless it is under way; one that was cut off can still be gone on with. */
    fun newMission()

    /** Looks for past missions on the disk. */
    fun lookForPast()
}
