package stillwater.estimate

import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin

/**
 * Discrete Fourier transform of [size] points, a power of two, in place (radix 2). Allocates nothing after it is
 * built.
 */
internal class Fourier(val size: Int) {
    init {
        require(size >= 2 && size and (size - 1) == 0) { "size ($size) must be a power of two, at least 2" }
    }

    private val cosines = DoubleArray(size / 2) { cos(2 * PI * it / size) }
    private val sines = DoubleArray(size / 2) { -sin(2 * PI * it / size) }

    /** Transforms [re] + i [im], length [size]; backwards without the factor 1/size. Modified. */
    fun transform(re: DoubleArray, im: DoubleArray, backwards: Boolean) {
        reorder(re, im)
        var half = 1
        while (half < size) {
            val stride = size / (2 * half)
            for (begin in 0 until size step 2 * half) {
                for (k in 0 until half) {
                    val c = cosines[k * stride]
                    val s = if (backwards) -sines[k * stride] else sines[k * stride]
                    val a = begin + k
                    val b = a + half
                    val x = re[b] * c - im[b] * s
                    val y = re[b] * s + im[b] * c
                    re[b] = re[a] - x
                    im[b] = im[a] - y
                    re[a] += x
                    im[a] += y
                }
            }
            half *= 2
        }
    }

    private fun reorder(re: DoubleArray, im: DoubleArray) {
        var j = 0
        for (i in 1 until size) {
            var bit = size shr 1
            while (j and bit != 0) {
                j = j xor bit
                bit = bit shr 1
            }
            j = j xor bit
            if (i < j) {
                re[i] = re[j].also { re[j] = re[i] }
                im[i] = im[j].also { im[j] = im[i] }
            }
        }
    }
}
