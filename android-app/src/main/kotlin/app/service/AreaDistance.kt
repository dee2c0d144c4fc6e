package stillwater.app.service

import stillwater.mission.MissionSpec
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.WaterArea

/** How far the boat is from a mission's water. Confined to the boat's thread. */
internal class AreaDistance {
    private var spec: MissionSpec? = null
    private var shore: WaterArea? = null
    private var frame: LocalFrame? = null

    /** From [place] to the shore of [spec], m; 0 within it, keep-outs or not. */
    fun metresTo(spec: MissionSpec, place: LatLon): Double {
        if (spec !== this.spec) {
            this.spec = spec
            shore = WaterArea(spec.area.corners())
            frame = LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude))
        }
        val at = checkNotNull(frame).toLocal(place)
        val water = checkNotNull(shore)
        return if (at in water) 0.0 else water.distanceToOutline(at.x, at.y)
    }
}
