package stillwater.report

import kotlinx.serialization.json.JsonObjectBuilder
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonObject
import stillwater.model.LocalFrame

/** Says under `origin` where on the globe the places of [frame] are counted from; nothing where they are in metres. */
internal fun JsonObjectBuilder.putOrigin(frame: LocalFrame?) {
    val origin = (frame ?: return).origin
    putJsonObject("origin") {
        put("lat_deg", origin.latitudeDeg)
        put("lon_deg", origin.longitudeDeg)
    }
}
