package stillwater.app.screen

import android.app.Activity
import android.app.Application
import android.content.ComponentName
import android.graphics.Bitmap
import android.graphics.Canvas
import android.os.Looper
import android.os.StrictMode
import android.view.View
import android.widget.TextView
import com.sun.management.ThreadMXBean
import org.junit.After
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import stillwater.app.R
import stillwater.app.service.BoatService
import stillwater.mission.LogStart
import stillwater.mission.MissionLog
import stillwater.mission.MissionState
import stillwater.mission.ReadingVerdict
import stillwater.mission.StepRecord
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.model.Reading
import stillwater.wire.Message
import java.io.File
import java.lang.management.ManagementFactory
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * From nothing to the live map, after the process died in the middle of a mission: the service, the window, the log of
 * half an hour read back, the map drawn. No disk and no link on the main thread meanwhile.
 *
 * What the main thread does for it does not grow with the log. How long it takes is written to `target/cold-start.txt`
 * beside what an empty window takes on the same machine, and judged by whoever reads it: a busy machine proves nothing.
 */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class ColdStartTest {
    private val context: Application = RuntimeEnvironment.getApplication()

    @Before
    fun nothingWaitsOnTheMainThread() {
        Background.executor = AnotherThread
    }

    @After
    fun lax() = StrictMode.setThreadPolicy(StrictMode.ThreadPolicy.LAX)

    @Test
    fun theMapOfAMissionThatWasCutOffIsDrawnWithoutWaiting() {
        writeLog()
        val empty = List(2) { milliseconds(::emptyWindow) }
        val live = List(2) { milliseconds(::liveMap) }
        File("target").mkdirs()
        File("target/cold-start.txt").writeText(
            "milliseconds, the first time in this process and the second\n" +
                "an empty window: ${empty[0]}, ${empty[1]}\nto the live map: ${live[0]}, ${live[1]}\n",
        )
    }

    /**
     * Bytes that the main thread allocates stand for the work that it does, and are the same on any machine: of a log
     * three times as long it does no more. The trace and the track of both are as long as they get.
     */
    @Test
    fun whatTheMainThreadDoesDoesNotGrowWithTheLog() {
        writeLog()
        liveMap()
        val (long, short) = listOf(STEPS, STEPS / LONGER).map { steps ->
            writeLog(steps)
            allocated(::liveMap)
        }
        assertTrue(long < short * MOST_GROWTH, "$long bytes for $STEPS steps, $short for ${STEPS / LONGER}")
    }

    private fun allocated(work: () -> Unit): Long {
        val threads = ManagementFactory.getThreadMXBean() as ThreadMXBean
        val before = threads.getThreadAllocatedBytes(Thread.currentThread().id)
        work()
        return threads.getThreadAllocatedBytes(Thread.currentThread().id) - before
    }

    /** What Android itself takes, on this machine, for a window with a word in it. */
    private fun emptyWindow() {
        val window = Robolectric.buildActivity(Activity::class.java).setup()
        window.get().setContentView(TextView(window.get()).apply { text = "empty" })
        draw(window.get())
        window.pause().stop().destroy()
    }

    private fun liveMap() {
        StrictMode.setThreadPolicy(STRICT)
        val service = Robolectric.buildService(BoatService::class.java).create()
        shadowOf(context).setComponentNameAndServiceForBindService(
            ComponentName(context, BoatService::class.java),
            service.get().onBind(null),
        )
        val window = Robolectric.buildActivity(MainActivity::class.java).setup()
        // The log is read on the disk's thread, the map comes with the screen's next look: half a second at most.
        shadowOf(service.get().diskLooper).idle()
        shadowOf(service.get().boatLooper).idle()
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofMillis(500))
        val drawn = draw(window.get())
        StrictMode.setThreadPolicy(StrictMode.ThreadPolicy.LAX)

        val map = window.get().view<MapView>(R.id.map)
        assertEquals("Map: 20 of 240 cells measured. Tap a cell for its bounds.", map.contentDescription)
        assertTrue(map.scene.track.size > 20, "the way is there, too")
        val colours = IntArray(drawn.width * drawn.height)
        drawn.getPixels(colours, 0, drawn.width, 0, 0, drawn.width, drawn.height)
        assertTrue(colours.toSet().size > 20, "cells are coloured")
        val threads = listOf(service.get().boatLooper.thread, service.get().diskLooper.thread)
        window.pause().stop().destroy()
        service.destroy()
        threads.forEach { it.join() }
    }

    private fun draw(activity: Activity): Bitmap {
        val view: View = activity.window.decorView
        view.measure(exactly(WIDTH), exactly(HEIGHT))
        view.layout(0, 0, WIDTH, HEIGHT)
        return Bitmap.createBitmap(WIDTH, HEIGHT, Bitmap.Config.ARGB_8888).also { view.draw(Canvas(it)) }
    }

    private fun exactly(size: Int) = View.MeasureSpec.makeMeasureSpec(size, View.MeasureSpec.EXACTLY)

    private fun milliseconds(work: () -> Unit): Long {
        val start = System.nanoTime()
        work()
        return (System.nanoTime() - start) / NANOS_PER_MILLI
    }

    /** Half an hour of ten steps a second and a reading a second, along the first row of cells. */
    private fun writeLog(steps: Int = STEPS) {
        val lines = ArrayList<String>()
        val log = MissionLog(lines::add, LogStart(1_784_000_000_000, "2026-07-14 03:33:20"), Scenes.spec)
        val grid = Scenes.spec.grid.grid()
        for (step in 1..steps) {
            val now = BoatTime(step * STEP)
            val cell = grid.center(step * grid.columns / (steps + 1))
            val place = cell.moved((step % PACE) * CREEP, 0.0)
            if (step % STEPS_A_READING == 0) {
                val reading = Reading(now, place, 7.0 + 2.0 * place.x / 100)
                log.reading(now, Message.Oxygen(1, reading.value), ReadingVerdict.PASSED, listOf(reading), null)
            }
            log.step(StepRecord(now, MissionState.Surveying, place, 0.0, Drive.NONE, step * CREEP, 0))
        }
        BoatService.logOf(context, "2026-07-14T03-33-20-North-pond.log.incomplete").apply {
            parentFile?.mkdirs()
            writeText(lines.joinToString("\n", postfix = "\n"))
        }
    }

    private companion object {
        const val WIDTH = 822
        const val HEIGHT = 1462
        const val NANOS_PER_MILLI = 1_000_000
        const val STEPS = 18_000
        const val STEP = 0.1
        const val STEPS_A_READING = 10
        const val PACE = 20
        const val CREEP = 0.05

        /** Ten minutes, which fill the trace. */
        const val LONGER = 3
        const val MOST_GROWTH = 1.25
    }
}
