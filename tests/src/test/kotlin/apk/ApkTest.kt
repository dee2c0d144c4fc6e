package stillwater.apk

import org.junit.jupiter.api.BeforeEach
import java.nio.ByteBuffer
import java.nio.ByteOrder
import java.util.zip.ZipFile
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** The app as it is installed. That it is signed, the packager checks itself before the file gets its name. */
class ApkTest {
    private val apk = Built.app.resolve("target/stillwater.apk")

    @BeforeEach
    fun theApkIsBuilt() {
        Built.existing(apk, "`mvn package`")
    }

    @Test
    fun itAsksForWhatItNeedsAndForNoNetwork() {
        val asked = badging().filter {
            it.startsWith("uses-permission")
        }.map { it.substringAfter("name='").dropLast(1) }
        val expected =
            listOf(
                "ACCESS_COARSE_LOCATION",
                "ACCESS_FINE_LOCATION",
                "BLUETOOTH' maxSdkVersion='30",
                "BLUETOOTH_CONNECT",
                "FOREGROUND_SERVICE",
                "FOREGROUND_SERVICE_CONNECTED_DEVICE",
                "FOREGROUND_SERVICE_LOCATION",
                "POST_NOTIFICATIONS",
                "REQUEST_IGNORE_BATTERY_OPTIMIZATIONS",
                "WAKE_LOCK",
            )
        assertEquals(expected, asked.map { it.removePrefix("android.permission.") }.sorted())
    }

    @Test
    fun itRunsOnTheAndroidsThatItPromises() {
        val badging = badging()
        for (line in listOf("minSdkVersion:'26'", "targetSdkVersion:'35'")) assertTrue(line in badging, "$badging")
        assertTrue(badging.first().startsWith("package: name='stillwater.app'"), badging.first())
        assertTrue(badging.none { it.startsWith("uses-feature:") && "touch" in it }, "no feature is required")
    }

    @Test
    fun itIsSmall() {
        assertTrue(apk.length() < 8_000_000, "${apk.length()} bytes")
    }

    /**
     * The packager verifies the signatures themselves; here, that both are there for those who ask.
     *
     * Source: Android's documentation of APK Signature Scheme v2, "APK Signing Block": between the entries and the
     * central directory, pairs of a length (8 bytes) and an identifier (4), the length of all (8), a magic word (16).
     */
    @Test
    fun itIsSignedByTheSchemesTwoAndThree() {
        val bytes = ByteBuffer.wrap(apk.readBytes()).order(ByteOrder.LITTLE_ENDIAN)
        val end = (bytes.limit() - END_SIZE downTo 0).first { bytes.getInt(it) == END_MARK }
        val directory = bytes.getInt(end + 16)
        assertEquals("APK Sig Block 42", String(bytes.array(), directory - 16, 16))
        val size = bytes.getLong(directory - 24).toInt()
        val schemes = mutableSetOf<Int>()
        var pair = directory - size
        while (pair < directory - 24) {
            schemes += bytes.getInt(pair + 8)
            pair += 8 + bytes.getLong(pair).toInt()
        }
        assertTrue(SCHEME_2 in schemes && SCHEME_3 in schemes, "$schemes")
    }

    /** Android maps what is stored into memory, and wants it at a multiple of four. */
    @Test
    fun whatIsStoredIsAligned() {
        val bytes = ByteBuffer.wrap(apk.readBytes()).order(ByteOrder.LITTLE_ENDIAN)
        val end = (bytes.limit() - END_SIZE downTo 0).first { bytes.getInt(it) == END_MARK }
        var entry = bytes.getInt(end + 16)
        var stored = 0
        repeat(bytes.getShort(end + 10).toInt()) {
            val nameLength = bytes.getShort(entry + 28)
            val name = String(bytes.array(), entry + 46, nameLength.toInt())
            if (bytes.getShort(entry + 10).toInt() == 0) {
                val local = bytes.getInt(entry + 42)
                val data = local + 30 + bytes.getShort(local + 26) + bytes.getShort(local + 28)
                assertEquals(0, data % 4, "$name begins at $data")
                stored++
            }
            entry += 46 + nameLength + bytes.getShort(entry + 30) + bytes.getShort(entry + 32)
        }
        assertTrue(stored > 0, "resources.arsc at least is stored")
    }

    @Test
    fun itHoldsTheAppItsLibrariesAndNothingElse() {
        val types = dexes().flatMap { it.defined }
        val expected = listOf("stillwater/", "kotlin/", "kotlinx/serialization/") + ANNOTATIONS
        val foreign = types.filter { type -> expected.none { type.startsWith("L$it") } }
        assertTrue(types.isNotEmpty() && foreign.isEmpty(), "$foreign")
        // What the phone does not run has no place there, nor has anything that only that leads to.
        val diagnosis = types.filter { it.startsWith("Lstillwater/diagnose/") }
        assertTrue(diagnosis.isEmpty(), "$diagnosis")
    }

    /**
     * The packager looks at the class files; here, that the dex itself names nothing that neither it nor Android has.
     */
    @Test
    fun nothingInItLeadsToAClassThatIsNowhere() {
        val dexes = dexes()
        val defined = dexes.flatMap { it.defined }.toSet()
        val named = dexes.flatMap { it.named }.map { it.trimStart('[') }.filter { it.startsWith("L") }.toSet()
        val nowhere = (named - defined).filter { type -> OF_ANDROID.none { type.startsWith(it) } }
        assertTrue(nowhere.all { it.startsWith(USB) }, "$nowhere")
        assertTrue(nowhere.isNotEmpty(), "the USB library's are named and looked for first, so names are seen at all")
    }

    private fun dexes(): List<Dex> = ZipFile(apk).use { zip ->
        zip.entries().asSequence().filter { it.name.endsWith(".dex") }
            .map { Dex(zip.getInputStream(it).readBytes()) }.toList()
    }

    /** Class descriptors in a dex file. Source: the Dalvik executable format, version 035 to 040. */
    private class Dex(private val dex: ByteArray) {
        private val bytes = ByteBuffer.wrap(dex).order(ByteOrder.LITTLE_ENDIAN)

        /** All types that are named. */
        val named = List(bytes.getInt(64)) { text(bytes.getInt(bytes.getInt(68) + 4 * it)) }

        /** Those that are defined. */
        val defined = List(bytes.getInt(96)) { named[bytes.getInt(bytes.getInt(100) + 32 * it)] }

        private fun text(index: Int): String {
            var start = bytes.getInt(bytes.getInt(60) + 4 * index)
            // The length, of seven bits a byte, then the characters and a zero.
            while (dex[start++] < 0) Unit
            return String(dex, start, (start until dex.size).first { dex[it] == 0.toByte() } - start)
        }
    }

    private fun badging(): List<String> {
        val aapt2 = Built.app.resolve("target/tools").walk().first { it.isFile && it.name.startsWith("aapt2") }
        val process = ProcessBuilder(aapt2.path, "dump", "badging", apk.path).redirectErrorStream(true).start()
        val lines = process.inputStream.bufferedReader().readLines()
        assertEquals(0, process.waitFor(), lines.joinToString("\n"))
        return lines
    }

    private companion object {
        const val END_MARK = 0x06054b50
        const val END_SIZE = 22
        const val SCHEME_2 = 0x7109871a
        const val SCHEME_3 = -0xfac9740 // 0xf05368c0

        const val USB = "Lcom/hoho/android/usbserial/"

        /** What every Android of the app's levels has; which calls of it, animal-sniffer looks at. */
        val OF_ANDROID = listOf("Landroid/", "Ldalvik/", "Ljava/", "Ljavax/")

        /** What comes with Kotlin's own library, and what D8 marks the classes with that it makes. */
        val ANNOTATIONS =
            listOf("org/jetbrains/annotations/", "org/intellij/lang/annotations/", "com/android/tools/r8/annotations/")
    }
}
