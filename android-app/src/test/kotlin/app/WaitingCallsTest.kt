package stillwater.app

import org.junit.Test
import org.junit.runner.RunWith
import org.objectweb.asm.ClassReader
import org.objectweb.asm.ClassVisitor
import org.objectweb.asm.Handle
import org.objectweb.asm.MethodVisitor
import org.objectweb.asm.Opcodes
import org.robolectric.RobolectricTestRunner
import org.robolectric.annotation.Config
import java.io.File
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * Whatever in the app's classes may wait for the disk or the link says so first, by [mayWait]: itself, or each way that
 * leads to it. What is said on the main thread throws where StrictMode looks (`StrictModeTest`, `DemoTest`,
 * `ColdStartTest`); so nothing can wait there unseen, though Robolectric sees no files of Java's and no sockets.
 */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class WaitingCallsTest {
    private data class Call(val owner: String, val name: String)

    private class Code(val calls: MutableSet<Call> = HashSet())

    private val supers = HashMap<String, List<String>>()
    private val codes = HashMap<Call, Code>()
    private val byName by lazy { codes.keys.groupBy(Call::name) }
    private val above = HashMap<String, Set<String>>()

    @Test
    fun whatMayWaitIsSaidFirst() {
        File("target/classes").walk().filter { it.extension == "class" }.forEach { read(it.readBytes()) }
        val waiting = codes.filterValues { code -> code.calls.any(::waits) }.keys
        assertTrue(waiting.size > WAITING_AT_LEAST, "they are found at all: $waiting")
        val callers = HashMap<Call, MutableSet<Call>>()
        for ((method, code) in codes) {
            for (call in code.calls) for (target in targets(call)) callers.getOrPut(target, ::HashSet) += method
        }
        val unsaid = waiting.filter { isReachedUnsaid(it, callers) }.map { "${it.owner}.${it.name}" }
        assertEquals(emptyList(), unsaid.sorted(), "these wait, and there is a way to them on which nobody has said so")
    }

    /**
     * Whether a way leads to [method], from where Android or a thread comes in, on which nobody says that it may wait.
     */
    private fun isReachedUnsaid(method: Call, callers: Map<Call, Set<Call>>): Boolean {
        if (says(method)) return false
        val seen = hashSetOf(method)
        val next = ArrayDeque(seen)
        while (next.isNotEmpty()) {
            val at = next.removeFirst()
            val from = callers[at].orEmpty() - at
            if (from.isEmpty()) return true
            for (caller in from) if (!says(caller) && seen.add(caller)) next += caller
        }
        return false
    }

    /** It says so, or calls one that does. */
    private fun says(method: Call) =
        saysItself(method) || codes.getValue(method).calls.any { it in codes && saysItself(it) }

    private fun saysItself(method: Call) = codes.getValue(method).calls.any { it.name == "mayWait" }

    /** The methods of the app that a call may come to: of the class itself, and of those that take its place. */
    private fun targets(call: Call): List<Call> =
        when {
            call in codes && call.name == "<init>" -> listOf(call)
            // What Android and Kotlin call by their own interfaces begins a way.
            !call.owner.startsWith(OURS) -> emptyList()
            else -> byName[call.name].orEmpty().filter { call.owner == it.owner || call.owner in allSupers(it.owner) }
        }

    private fun allSupers(owner: String): Set<String> =
        above[owner] ?: supers[owner].orEmpty().flatMap { allSupers(it) + it }.toSet().also { above[owner] = it }

    private fun waits(call: Call) = WAITING[call.owner]?.let { it.isEmpty() || call.name in it } == true

    private fun read(bytes: ByteArray) =
        ClassReader(bytes).accept(
            object : ClassVisitor(Opcodes.ASM9) {
                private lateinit var owner: String

                override fun visit(v: Int, a: Int, name: String, s: String?, parent: String?, all: Array<String>?) {
                    owner = name
                    supers[name] = listOfNotNull(parent) + all.orEmpty()
                }

                override fun visitMethod(a: Int, name: String, d: String, s: String?, e: Array<String>?) =
                    collector(codes.getOrPut(Call(owner, name), ::Code))
            },
            ClassReader.SKIP_DEBUG or ClassReader.SKIP_FRAMES,
        )

    private fun collector(code: Code) =
        object : MethodVisitor(Opcodes.ASM9) {
            override fun visitMethodInsn(opcode: Int, owner: String, name: String, d: String, isInterface: Boolean) {
                code.calls += Call(owner, name)
            }

            /** A lambda is called by whoever has made it. */
            override fun visitInvokeDynamicInsn(name: String, d: String, bootstrap: Handle, vararg arguments: Any) {
                arguments.filterIsInstance<Handle>().forEach { code.calls += Call(it.owner, it.name) }
            }
        }

    private companion object {
        const val WAITING_AT_LEAST = 10
        const val OURS = "stillwater/app/"

        /**
         * Classes of Java, Kotlin, Android and the USB library, and which of their functions may wait; all, where none
         * is named.
         */
        val WAITING =
            mapOf(
                "java/io/RandomAccessFile" to emptySet(),
                "java/io/FileDescriptor" to setOf("sync"),
                "java/io/FileInputStream" to emptySet(),
                "java/io/FileOutputStream" to emptySet(),
                "java/io/File" to
                    setOf(
                        "listFiles", "list", "exists", "isFile", "isDirectory", "mkdir", "mkdirs", "renameTo", "delete",
                        "length", "lastModified", "getUsableSpace", "createNewFile", "setLastModified",
                    ),
                "kotlin/io/FilesKt" to
                    setOf("readText", "writeText", "readBytes", "writeBytes", "forEachLine", "readLines"),
                "kotlin/io/FilesKt__FileReadWriteKt" to emptySet(),
                "java/io/InputStream" to setOf("read"),
                "java/io/OutputStream" to setOf("write", "flush"),
                "java/net/Socket" to emptySet(),
                "android/content/Context" to setOf("getFilesDir", "getCacheDir", "openFileInput", "openFileOutput"),
                "android/content/ContentResolver" to setOf("openInputStream", "openOutputStream"),
                "android/content/SharedPreferences" to setOf("getString"),
                "android/content/SharedPreferences\$Editor" to setOf("commit"),
                "android/provider/DocumentsContract" to setOf("deleteDocument"),
                "android/bluetooth/BluetoothSocket" to setOf("connect"),
                "android/hardware/usb/UsbManager" to setOf("openDevice"),
                "com/hoho/android/usbserial/driver/UsbSerialPort" to setOf("open", "read", "write"),
            )
    }
}
