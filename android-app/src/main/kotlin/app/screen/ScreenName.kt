package stillwater.app.screen

import stillwater.app.R

/**
 * The screens, in the order of the menu.
 *
 * @property title what the menu calls it.
 * @property about what it is for, in a few words; null where it is not in the menu.
 */
internal enum class ScreenName(val title: Int, val about: Int? = null) {
    MAP(R.string.screen_map, R.string.about_map),
    TRACE(R.string.screen_trace, R.string.about_trace),
    START(R.string.screen_start, R.string.about_start),
    MISSION(R.string.screen_mission, R.string.about_mission),
    LINK(R.string.screen_link, R.string.about_link),
    PAST(R.string.screen_past, R.string.about_past),
    AREA(R.string.screen_area),
    MENU(R.string.screen_menu),
}
