package stillwater.cli

/** Platypus logs with something wrong, for [MapBadInputTest]. */
internal object BadPlatypusLogs {
    private fun pose(millis: Int, zone: String = "17North", east: Double = 592_300.0) =
        "$millis\tI\t{\"pose\":{\"p\":[${east + millis * 1e-3},4481762.0,252]," +
            "\"q\":[1,0,0,0],\"zone\":\"$zone\"}}\n"

    private fun reading(millis: Int, data: String = "7.$millis") =
        "$millis\tI\t{\"sensor\":{\"channel\":1,\"type\":\"ATLAS_DO\",\"data\":[$data]}}\n"

    private val PLATYPUS = "0\tI\t{\"date\":\"Thu May 19\",\"time\":1463679383361}\n" +
        (1..9).joinToString("") { pose(100 * it) + reading(100 * it + 50) }

    private fun platypus(
        name: String,
        more: String,
        message: String,
        skipped: String? = null,
        vararg flags: String,
    ) =
        MapBadInputTest.Case(
            name,
            (PLATYPUS + more).toByteArray(),
            message,
            skipped,
            flags.toList(),
            "platypus_log.txt",
        )

    @JvmStatic
    fun all() = listOf(
        platypus(
            "zone 99",
            pose(2000, "99North"),
            "log.txt:20: expected a UTM zone 1North to 60South, found '99North'",
            "poses in no UTM zone",
        ),
        platypus("power cut", "\u0000".repeat(300), "found 300 zero bytes", "unreadable lines"),
        platypus(
            "another zone",
            pose(2000, "56North"),
            "log.txt:20: ${MapBadInputTest.FAR}",
            MapBadInputTest.FAR_REASON,
        ),
        platypus("endless value", reading(2000, "1e301"), MapBadInputTest.WITHIN, "readings out of all bounds"),
        platypus(
            "endless start",
            "2000\tI\t{\"date\":\"x\",\"time\":1e999}\n",
            "log.txt:20: expected a start",
            "unreadable lines",
        ),
        platypus("zone without a half", pose(2000, "18West"), "found '18West'", "poses in no UTM zone"),
        platypus(
            "off the zone",
            pose(2000, east = 5e6),
            "expected UTM easting in 0..1000000",
            "poses off the globe",
        ),
        platypus(
            "cut last line",
            "2000\tI\t{\"pose\":{\"p\":[592300.9,44",
            "log.txt:20: expected a JSON object",
            "unreadable lines",
        ),
        platypus("no log line", "what is this\n", "log.txt:20: expected a line '<ms> TAB", "unreadable lines"),
        platypus("broken pose", "2000\tI\t{\"pose\":{\"p\":[1]}}\n", "expected a pose", "unreadable lines"),
        platypus("no number", reading(2000, "\"x\""), "expected a finite number", "readings that are no number"),
        platypus("duplicate time", reading(950), "expected a ATLAS_DO time after", "duplicate times"),
        platypus(
            "unknown sensor",
            "",
            "expected readings of ATLAS_PH, found ATLAS_DO (9 lines)",
            null,
            "--value",
            "ATLAS_PH",
        ),
        platypus("malformed sensor", "", "expected --value TYPE[#CHANNEL][.FIELD]", null, "--value", "a b"),
        platypus("columns", "", "expected a survey CSV for column lat", null, "--lat", "lat"),
        platypus(
            "two channels",
            reading(2000).replace(":1,", ":2,"),
            "expected --value with one of ATLAS_DO#1, ATLAS_DO#2",
        ),
    )
}
