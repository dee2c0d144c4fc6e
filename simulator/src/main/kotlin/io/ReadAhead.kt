package stillwater.io

import java.io.IOException
import java.io.InterruptedIOException
import java.io.Reader
import java.util.concurrent.ArrayBlockingQueue
import kotlin.concurrent.thread

/**
 * The same text as [source], read and decoded on another core while what came before is used.
 *
 * Who reads it is confined to one thread; [source] is read, and closed, on another. Close it in all cases: that thread
 * waits for as long.
 */
internal class ReadAhead(private val source: Reader) : Reader() {
    /** Text, or why there is none: its end where [length] is below 0. */
    private class Block {
        val text = CharArray(CHARACTERS)
        var length = 0
        var failure: Throwable? = null
    }

    private val read = ArrayBlockingQueue<Block>(BLOCKS)
    private val used = ArrayBlockingQueue<Block>(BLOCKS).apply { repeat(BLOCKS) { add(Block()) } }
    private var block: Block? = null
    private var at = 0
    private val reader = thread(isDaemon = true, name = "read ahead") { readAll() }

    private fun readAll() = try {
        source.use {
            do {
                val goesOn = fill(used.take())
            } while (goesOn)
        }
    } catch (_: InterruptedException) {
        // Closed before the end.
    } catch (_: IOException) {
        // Nothing more is read of what cannot be closed.
    }

    /** Reads the next [block]; whether another may follow. */
    private fun fill(block: Block): Boolean {
        val failure = runCatching { block.length = source.read(block.text) }.exceptionOrNull()
        block.failure = failure
        read.put(block)
        return failure == null && block.length >= 0
    }

    override fun read(buffer: CharArray, offset: Int, length: Int): Int {
        if (length == 0) return 0
        val block = block ?: next()
        block.failure?.let { throw it }
        if (block.length < 0) return -1
        val count = minOf(length, block.length - at)
        block.text.copyInto(buffer, offset, at, at + count)
        at += count
        if (at == block.length) {
            this.block = null
            // There is room for all blocks, so that nobody waits who could be interrupted.
            used.add(block)
        }
        return count
    }

    private fun next(): Block = try {
        at = 0
        read.take().also { block = it }
    } catch (_: InterruptedException) {
        Thread.currentThread().interrupt()
        throw InterruptedIOException("interrupted")
    }

    /** Returns when [source] is closed. */
    override fun close() {
        reader.interrupt()
        try {
            reader.join()
        } catch (_: InterruptedException) {
            Thread.currentThread().interrupt()
        }
    }

    private companion object {
        const val CHARACTERS = 1 shl 16
        const val BLOCKS = 4
    }
}
