package stillwater.report

import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.createDirectories
import kotlin.io.path.createDirectory
import kotlin.io.path.exists
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.name
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class OutputDirectoryTest {
    @TempDir
    lateinit var home: Path

    private fun everything() = Files.walk(home).use { all ->
        all.map { home.relativize(it).toString() }.toList().sorted()
    }

    @Test
    fun aPlaceWhereNothingCanBeCreatedIsSaidInWords() {
        val place = Path.of("/proc/stillwater")
        assumeTrue(place.parent.exists(), "no /proc here")
        val refused = assertFailsWith<OutputException> { OutputDirectory(place) }.message.orEmpty()
        // Root meets the system's refusal, others that of their rights.
        val ends = listOf("the system lets nothing be created there", "permission denied", "not permitted")
        assertTrue(ends.any { it in refused.lowercase() }, refused)
    }

    @Test
    fun commitMovesEverythingInTheOrderOfWritingAndCreatesParents() {
        val out = home.resolve("a/b/out")
        val written = OutputDirectory(out).use {
            it.write("z.txt", "last letter, first file")
            it.write("figures/a.bin", byteArrayOf(1, 2))
            it.commit()
        }
        assertEquals(listOf(out.resolve("z.txt"), out.resolve("figures/a.bin")), written)
        assertEquals("last letter, first file", out.resolve("z.txt").readText())
        assertEquals(
            listOf("", "a", "a/b", "a/b/out", "a/b/out/figures", "a/b/out/figures/a.bin", "a/b/out/z.txt"),
            everything(),
        )
    }

    @Test
    fun aCommitReplacesItsOwnNamesAndLeavesOthersAlone() {
        val out = home.resolve("out").createDirectory()
        out.resolve("results.csv").writeText("old")
        out.resolve("notes.txt").writeText("mine")
        OutputDirectory(out).use {
            it.write("results.csv", "new")
            it.commit()
        }
        assertEquals("new", out.resolve("results.csv").readText())
        assertEquals("mine", out.resolve("notes.txt").readText())
    }

    @Test
    fun anInputIsNotReplaced() {
        val out = home.resolve("out").createDirectory()
        val input = out.resolve("cells.csv").apply { writeText("measured") }
        val problem = assertFailsWith<OutputException> {
            OutputDirectory(out, listOf(out.resolve("../out/cells.csv"))).use {
                it.write("report.html", "new")
                it.write("cells.csv", "computed")
                it.commit()
            }
        }
        assertContains(problem.message.orEmpty(), "cells.csv is the input itself")
        assertEquals("measured", input.readText())
        assertEquals(1, Files.list(out).use { it.count() })
    }

    @Test
    fun anInputMayBeWrittenAsItIsAndIsNotRetired() {
        val out = home.resolve("out").createDirectory()
        val input = out.resolve("sensor.json").apply { writeText("given") }
        OutputDirectory(out, listOf(input)).use {
            it.write("sensor.json", "given")
            it.commit()
        }
        val problem = assertFailsWith<OutputException> {
            OutputDirectory(out, listOf(input)).use {
                it.retire(listOf("sensor.json"))
                it.write("report.html", "new")
                it.commit()
            }
        }
        assertContains(problem.message.orEmpty(), "sensor.json is the input itself")
        assertEquals("given", input.readText())
        assertEquals(1, Files.list(out).use { it.count() })
    }

    @Test
    fun withoutCommitNothingChangesAndNothingIsLeft() {
        val out = home.resolve("out").createDirectory()
        out.resolve("results.csv").writeText("old")
        val before = everything()
        assertFailsWith<IllegalStateException> {
            OutputDirectory(out).use {
                it.write("results.csv", "half")
                error("stopped")
            }
        }
        assertEquals("old", out.resolve("results.csv").readText())
        assertEquals(before, everything())
        OutputDirectory(home.resolve("new/deep")).use { it.write("a", "b") }
        assertEquals(before, everything(), "parents made for nothing go again")
    }

    @Test
    fun nothingIsVisibleBeforeCommit() {
        val out = home.resolve("out")
        OutputDirectory(out).use {
            it.write("a.txt", "a")
            assertFalse(out.exists())
            assertEquals(1, home.listDirectoryEntries().size)
            assertTrue(home.listDirectoryEntries().single().name.startsWith(".out-unfinished-"))
            it.commit()
        }
        assertEquals(listOf("", "out", "out/a.txt"), everything())
    }

    @Test
    fun aFileInTheWayIsNamedInOneLine() {
        val file = home.resolve("file").also { it.writeText("x") }
        assertEquals(
            "output $file is a file; name a directory",
            assertFailsWith<OutputException> {
                OutputDirectory(file)
            }.message,
        )
        val below = assertFailsWith<OutputException> { OutputDirectory(file.resolve("below")) }.message.orEmpty()
        assertContains(below, "cannot create output directory ${file.resolve("below")}")
        assertFalse('\n' in below)
    }

    @Test
    fun aDirectoryInAFilesPlaceIsFoundBeforeAnythingMoves() {
        val out = home.resolve("out")
        out.resolve("b.txt").createDirectories()
        out.resolve("a.txt").writeText("old")
        val message = assertFailsWith<OutputException> {
            OutputDirectory(out).use {
                it.write("a.txt", "new")
                it.write("b.txt", "new")
                it.commit()
            }
        }.message
        assertEquals("cannot write ${out.resolve("b.txt")}: a directory of this name is in the way", message)
        assertEquals("old", out.resolve("a.txt").readText())
        assertEquals(listOf("", "out", "out/a.txt", "out/b.txt"), everything())
    }

    @Test
    fun aDirectoryThatMayNotBeWrittenIsRefused() {
        val out = home.resolve("locked").createDirectory()
        assumeTrue(out.toFile().setWritable(false) && !Files.isWritable(out), "root may write anywhere")
        assertEquals(
            "output directory $out is not writable",
            assertFailsWith<OutputException> {
                OutputDirectory(out)
            }.message,
        )
    }

    @Test
    fun aFullDiskIsAnOutputErrorAndLeavesTheOldFile() {
        val out = home.resolve("out").createDirectory()
        out.resolve("a.txt").writeText("old")
        val failed = assertFailsWith<OutputException> {
            OutputDirectory(out).use { it.stream("a.txt") { throw java.io.IOException("No space left on device") } }
        }
        assertEquals("cannot write a.txt in output directory $out: No space left on device", failed.message)
        assertEquals("old", out.resolve("a.txt").readText())
    }

    @Test
    fun namesOutsideTheDirectoryAndUseAfterCommitAreBugs() {
        OutputDirectory(home.resolve("out")).use {
            assertFailsWith<IllegalArgumentException> { it.write("../evil", "x") }
            assertFailsWith<IllegalArgumentException> { it.write("", "x") }
            it.commit()
            assertFailsWith<IllegalStateException> { it.write("late", "x") }
            assertFailsWith<IllegalStateException> { it.commit() }
        }
    }

    @Test
    fun writingANameTwiceKeepsTheLast() {
        val out = home.resolve("out")
        val written = OutputDirectory(out).use {
            it.write("a", "1")
            it.write("a", "2")
            it.commit()
        }
        assertEquals(1, written.size)
        assertEquals("2", out.resolve("a").readText())
    }

    @Test
    fun whatWasRetiredAndNotWrittenGoesOnCommitOnly() {
        val out = home.resolve("out").createDirectory()
        for (name in listOf("old.svg", "new.svg", "other.txt")) out.resolve(name).writeText("earlier")
        OutputDirectory(out).use { it.retire(listOf("old.svg", "new.svg")) }
        assertEquals(listOf("new.svg", "old.svg", "other.txt"), out.listDirectoryEntries().map { it.name }.sorted())
        OutputDirectory(out).use {
            it.retire(listOf("old.svg", "new.svg", "never.svg"))
            it.write("new.svg", "now")
            it.commit()
        }
        assertEquals(listOf("new.svg", "other.txt"), out.listDirectoryEntries().map { it.name }.sorted())
        assertEquals("now", out.resolve("new.svg").readText())
    }

    @Test
    fun whatIsNotOfAnEarlierRunOfTheCommandStays() {
        val out = home.resolve("out").createDirectories()
        fun write(name: String, command: String) =
            OutputDirectory(out, earlier = EarlierResults(command)).use {
                it.write(name, "new")
                it.write("report.html", "<p>Command: <code>stillwater $command log.csv</code></p>")
                it.commit()
            }
        val own = out.resolve("cells.csv").also { it.writeText("mine") }
        assertContains(
            assertFailsWith<OutputException> {
                write("cells.csv", "map")
            }.message.orEmpty(),
            "cells.csv is not of",
        )
        assertEquals("mine", own.readText())
        OutputDirectory(out.resolve("results"), earlier = EarlierResults("map")).use {
            it.write("report.html", "<p>Command: <code>stillwater map log.csv</code></p>")
            it.commit()
        }
        assertFailsWith<OutputException>("of results beside it") { write("cells.csv", "map") }
        write("other.csv", "map")
        write("cells.csv", "map")
        val refused = assertFailsWith<OutputException> { write("corrected.csv", "correct") }.message.orEmpty()
        assertContains(refused, "report.html is not of an earlier stillwater correct")
        assertContains(out.resolve("report.html").readText(), "stillwater map")
    }

    @Test
    fun resultsWithoutAReportAreToldByAWordInAFile() {
        val out = home.resolve("out").createDirectories()
        fun write() = OutputDirectory(out, earlier = EarlierResults("diagnose", "diagnosis.json" to "verdict")).use {
            it.write("diagnosis.json", """{"verdict": "consistent"}""")
            it.commit()
        }
        out.resolve("diagnosis.json").writeText("""{"mine": 1}""")
        assertFailsWith<OutputException> { write() }
        out.resolve("diagnosis.json").toFile().delete()
        write()
        write()
    }
}
