package stillwater.mission

/**
 * What a boat that was held up on its ways home has rested.
 *
 * @property count rests that it has begun since it last got on.
 * @property seconds that are left of the last, s; 0 where it is over and other ways are tried.
 */
public data class HomeRest(val count: Int, val seconds: Double)
