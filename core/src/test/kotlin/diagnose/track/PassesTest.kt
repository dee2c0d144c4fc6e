package stillwater.diagnose.track

import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals

/** How much of a track comes near another pass, and what is said where that is too little. */
class PassesTest {
    @Test
    fun onePassThatTooFewRowsMakeIsNotSaidToBeNone() {
        // A line of 400 m whose last five rows come back over its beginning.
        val x = DoubleArray(405) { if (it < 400) it.toDouble() else it - 400.0 }
        val y = DoubleArray(405) { if (it < 400) 0.0 else 0.5 }
        val share = Passes.share(x, y, 2.0)
        assertEquals(10.0 / 405, share, 2.1 / 405)
        assertContains(
            Passes.tooFew(share / 2, 0.02, "1.0", "m"),
            Regex("""only 1\.\d % of the rows come within 1\.0 m of another pass, where 2\.0 % are needed to tell"""),
        )
        assertContains(Passes.tooFew(0.0, 0.02, "1.0", "m"), "no pass comes within 1.0 m of another")
    }
}
