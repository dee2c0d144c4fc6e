package stillwater.app.service

import android.app.Application
import android.os.BatteryManager
import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.android.controller.ServiceController
import org.robolectric.annotation.Config
import stillwater.app.link.LinkChoice
import stillwater.app.mission.FileOutput
import stillwater.app.mission.LogOpener
import stillwater.app.mission.LogOutput
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import java.io.File
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/**
 * Two hours on the demo's water, in virtual time: nothing grows, nothing is lost. The numbers are written to
 * `target/long-mission.txt`.
 */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class LongMissionTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private lateinit var controller: ServiceController<BoatService>
    private val service get() = controller.get()
    private var passed = 0

    /** Times the disk was given something, and the most it was given at once, bytes. */
    @Volatile private var flushes = 0

    @Volatile private var longest = 0

    @After
    fun end() {
        controller.destroy()
        BoatService.logs = LogOpener(::FileOutput)
    }

    @Test
    fun twoHoursLeaveTheHeapFlatAndTheLogComplete() {
        shadowOf(context.getSystemService(BatteryManager::class.java)!!)
            .setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, 80)
        // The writer of the phone itself, looked over the shoulder.
        BoatService.logs =
            LogOpener { file ->
                val real = FileOutput(file)
                object : LogOutput by real {
                    override fun append(bytes: ByteArray) {
                        real.append(bytes)
                        flushes++
                        longest = maxOf(longest, bytes.size)
                    }
                }
            }
        controller = Robolectric.buildService(BoatService::class.java).create()
        service.onStartCommand(BoatService.startIntent(context, LinkChoice.Demo), 0, 1)
        service.load(ServiceDesk.POND.replace("\"seconds\":200", "\"seconds\":7150"))
        pass(5)
        val checks = service.snapshot.preflight
        assertTrue(service.snapshot.isDemo && checks.all { it.ready }, "$checks")
        service.start()
        // At the next look; what was said before it is no mission's.
        val before = assertNotNull(service.demoReadings)
        // What the first minutes load, and what Android's own start leaves, is gone or settled by then.
        pass(3000)
        val early = heap()
        pass(3000)
        assertEquals(MissionState.Surveying, service.snapshot.mission?.state)
        val late = heap()
        // The estimator's cells and the lists for the screens are of fixed size; the log alone grew by 14 MB meanwhile.
        assertTrue(late - early < MOST_GROWTH, "$early bytes after 50 min, $late after 100")

        pass(1000)
        while (service.snapshot.mission?.isOver != true && passed < LONGEST) pass(1)
        val sent = assertNotNull(service.demoReadings) - before
        // The log is closed on the disk's own thread.
        pass(CHUNK)
        val report = assertNotNull(service.snapshot.mission)
        assertEquals(MissionState.Stopped(StopReason.COMPLETED), report.state)
        assertTrue(report.isOver)
        val counts = report.counts
        assertTrue(counts.taken > 7000, "$counts")
        // By the virtual board's own count; at either end one may be under way, or come between two looks.
        assertTrue(sent - counts.received in -1..2, "the board sent $sent: $counts")
        assertEquals(counts.received, counts.taken, "the demo's probe says nothing that is doubted: $counts")
        assertEquals(0L, counts.unreadable)
        assertEquals(Gaps(), service.snapshot.gaps)

        val log = assertNotNull(report.log)
        assertTrue(log.isClosed && log.lost == 0L && log.written == log.lines && log.lines > 71_000, "$log")
        // The disk's thread keeps up to five seconds behind here, and each time has all that there was on the disk.
        assertTrue(flushes > 7_000 / CHUNK, "$flushes times on the disk")
        assertTrue(longest < MOST_AT_ONCE, "$longest bytes waited for the disk")
        val recovery = MissionRecovery()
        var lines = 0L
        BoatService.logOf(context, log.name).forEachLine {
            recovery.line(it)
            lines++
        }
        assertEquals(log.lines, lines)
        val read = assertNotNull(recovery.recovered())
        assertEquals(counts.taken, read.readings)
        assertEquals(0L, read.unreadable)
        assertEquals("stopped", read.lastState)
        File("target/long-mission.txt").apply { absoluteFile.parentFile.mkdirs() }.writeText(
            "heap in use after 50 min: $early bytes, after 100 min: $late\n" +
                "the board sent $sent readings\n$counts\n$log, " +
                "${BoatService.logOf(context, log.name).length()} bytes, $flushes times on the disk\n",
        )
    }

    /** Lets [seconds] s pass, files keeping up. */
    private fun pass(seconds: Int) {
        var left = seconds
        while (left > 0) {
            val chunk = minOf(left, CHUNK)
            shadowOf(service.boatLooper).idleFor(Duration.ofSeconds(chunk.toLong()))
            shadowOf(service.diskLooper).idle()
            left -= chunk
        }
        passed += seconds
    }

    /** What is in use once what is not has been thrown away. */
    private fun heap(): Long {
        repeat(3) { System.gc() }
        return Runtime.getRuntime().run { totalMemory() - freeMemory() }
    }

    private companion object {
        const val CHUNK = 5

        /** s, of which the budget is 7150. */
        const val LONGEST = 7_300
        const val MOST_GROWTH = 2_000_000L

        /** Five seconds of a log of 5 kB a second, and as much again; the first one has the mission, too. */
        const val MOST_AT_ONCE = 60_000
    }
}
