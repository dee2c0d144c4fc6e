package stillwater.run

import kotlinx.serialization.descriptors.SerialDescriptor
import stillwater.mission.EstimatorName
import stillwater.mission.PlannerName
import stillwater.mission.Quantity
import stillwater.virtual.Firmware

/** The estimator's name as in a mission's file. */
internal val EstimatorName.label: String get() = name(EstimatorName.serializer().descriptor, ordinal)

/** The planner's name as in a mission's file. */
internal val PlannerName.label: String get() = name(PlannerName.serializer().descriptor, ordinal)

/** The quantity's name for people. */
internal val Quantity.label: String get() = name(Quantity.serializer().descriptor, ordinal).replace('-', ' ')

/** The quantity's name for people with its unit, where it has one. */
internal val Quantity.withUnit: String get() = if (unit.isEmpty()) label else "$label ($unit)"

/** The firmware's name on the command line. */
internal val Firmware.label: String
    get() = when (this) {
        Firmware.V4_2 -> "v4.2.0"
        Firmware.MASTER -> "master"
    }

/** The filter of the command line that this is. */
internal val EstimatorName.kind: FilterKind get() = FilterKind.entries.first { it.label == label }

private fun name(descriptor: SerialDescriptor, index: Int) = descriptor.getElementName(index)
