package stillwater.closedloop

import stillwater.cli.Stillwater
import java.io.BufferedReader
import java.io.File
import java.net.URLClassLoader
import java.util.concurrent.TimeUnit
import kotlin.test.fail

/** `stillwater` with [arguments] in a process of its own, from the classes under test. */
internal class Program(directory: File, vararg arguments: String) : AutoCloseable {
    private val errors = File.createTempFile("stderr", ".txt", directory)
    private val process: Process = ProcessBuilder(
        listOf(
            File(System.getProperty("java.home"), "bin/java").path,
            "-XX:+UseSerialGC",
            "-XX:TieredStopAtLevel=1",
            "-cp",
            CLASS_PATH,
            "stillwater.cli.MainKt",
        ) + arguments,
    ).directory(directory).redirectError(errors).start()
    private val output: BufferedReader = process.inputStream.bufferedReader()
    private val said = ArrayList<String>()

    /** Reads what it prints until a line [isMeant]; answers that line. */
    fun await(isMeant: (String) -> Boolean): String {
        while (true) {
            val line = output.readLine() ?: fail("the program ended before that:\n$this")
            said += line
            if (isMeant(line)) return line
        }
    }

    /** Waits for its end; answers its exit code. */
    fun end(): Int {
        output.forEachLine(said::add)
        // Far longer than any of these takes on a busy machine; a process that hangs must not hold up the build.
        if (!process.waitFor(2, TimeUnit.MINUTES)) fail("the program does not end:\n$this")
        return process.exitValue()
    }

    /** Kills it on the spot, as a flat battery does. */
    fun kill() {
        process.destroyForcibly().waitFor()
    }

    /** Asks it to end, as Ctrl-C does. */
    fun interrupt() {
        // Not the process's own destroy, which closes its output.
        process.toHandle().destroy()
    }

    /** Tells it that its terminal was closed. */
    fun hangUp() {
        ProcessBuilder("kill", "-HUP", "${process.pid()}").start().waitFor()
    }

    override fun close() = kill()

    override fun toString() = (said + errors.readText()).joinToString("\n")

    private companion object {
        /** Where the classes under test come from: some test runners have a class loader of their own. */
        val CLASS_PATH: String = (Stillwater::class.java.classLoader as? URLClassLoader)?.urLs
            ?.joinToString(File.pathSeparator) { File(it.toURI()).path }
            ?: System.getProperty("java.class.path")
    }
}
