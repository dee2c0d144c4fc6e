package stillwater.simulation

import kotlinx.serialization.descriptors.SerialDescriptor
import stillwater.mission.EstimatorName
import stillwater.mission.PlannerName
import stillwater.mission.Quantity

/** The estimator's name as in a mission's file. */
internal val EstimatorName.label: String get() = name(EstimatorName.serializer().descriptor, ordinal)

/** The planner's name as in a mission's file. */
internal val PlannerName.label: String get() = name(PlannerName.serializer().descriptor, ordinal)

/** The quantity's name for people. */
internal val Quantity.label: String get() = name(Quantity.serializer().descriptor, ordinal).replace('-', ' ')

private fun name(descriptor: SerialDescriptor, index: Int) = descriptor.getElementName(index)
