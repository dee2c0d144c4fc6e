package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OperationsPerInvocation
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.State
import stillwater.wire.LineFramer
import stillwater.wire.PlatypusCodec
import java.util.concurrent.TimeUnit
import kotlin.random.Random

/** Bytes as a Platypus board sends them, through framer and codec to messages. */
@State(Scope.Thread)
@BenchmarkMode(Mode.Throughput)
@OutputTimeUnit(TimeUnit.SECONDS)
open class CodecBenchmark {
    private val random = Random(Survey.SEED)
    private val bytes = buildString { repeat(LINES) { append(line(it)).append("\r\n") } }.encodeToByteArray()
    private var heard = 0L
    private val framer = LineFramer(PlatypusCodec { heard++ })

    private fun line(index: Int): String = when (index % KINDS) {
        0 -> """{"s1":{"type":"atlas_do","data":"${random.nextInt(2000) / 100.0}"}}"""
        1 -> """{"s2":{"type":"es2","data":"${random.nextInt(2000)} ${random.nextInt(300) / 10.0}"}}"""
        2 -> """{"s0":{"type":"battery","data":"${14 + random.nextInt(30) / 10.0} 0.1 0.2"}}"""
        else -> """{"m0":{"v":${random.nextInt(100) / 100.0},"c":0.4},"m1":{"v":0.25,"c":0.3}}"""
    }

    @Benchmark
    @OperationsPerInvocation(LINES)
    fun lines(): Long {
        framer.accept(bytes)
        return heard
    }

    private companion object {
        const val LINES = 1000
        const val KINDS = 4
    }
}
