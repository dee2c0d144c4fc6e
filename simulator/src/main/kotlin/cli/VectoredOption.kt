package stillwater.cli

import com.github.ajalt.clikt.core.ParameterHolder
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.control.Mixing
import stillwater.mission.MissionSpec

/** `--vectored`, the same for every command that has a boat. */
internal fun ParameterHolder.vectoredFlag() = option(
    "--vectored",
    help = "the boat has one thruster that swivels in place of two that do not, as a mission with boat.mixing " +
        "vectored says by itself",
).flag()

/** This mission with the boat that `--vectored` asks for where it is [given]; the log then says so, too. */
internal fun MissionSpec.vectoredWhere(given: Boolean): MissionSpec =
    if (given) copy(boat = boat.copy(mixing = Mixing.VECTORED)) else this
