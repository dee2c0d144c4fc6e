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

/** The quantity's unit; empty where it has none. */
internal val Quantity.unit: String
    get() = when (this) {
        Quantity.DISSOLVED_OXYGEN -> "mg/L"
        Quantity.ACIDITY -> ""
        Quantity.CONDUCTIVITY -> "µS/cm"
        Quantity.TEMPERATURE -> "°C"
        Quantity.DEPTH -> "m"
    }

private fun name(descriptor: SerialDescriptor, index: Int) = descriptor.getElementName(index)
