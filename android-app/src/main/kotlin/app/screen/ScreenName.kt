package stillwater.app.screen

import stillwater.app.R

/** The screens, in the order of the menu; [title] is what it calls them. */
internal enum class ScreenName(val title: Int, val inMenu: Boolean = true) {
    MAP(R.string.screen_map),
    TRACE(R.string.screen_trace),
    START(R.string.screen_start),
    MISSION(R.string.screen_mission),
    LINK(R.string.screen_link),
    PAST(R.string.screen_past),
    AREA(R.string.screen_area, inMenu = false),
    MENU(R.string.screen_menu, inMenu = false),
}
