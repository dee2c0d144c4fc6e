package stillwater.app.screen

import android.content.Context
import android.widget.ScrollView
import stillwater.app.R
import stillwater.app.mission.MissionReport
import stillwater.app.mission.TracePoint
import stillwater.app.service.BoatSnapshot
import stillwater.app.setup.words
import stillwater.model.Grid
import stillwater.model.Interval

/** The probe's last minutes in numbers and as a curve. */
internal class TraceScreen(private val context: Context) : Screen {
    private val reading = context.line("").apply { id = R.id.trace_reading }
    private val corrected = context.line("", R.color.plan).apply { id = R.id.trace_corrected }
    private val gradient = context.line("").apply { id = R.id.trace_gradient }
    private val trace = TraceView(context).apply { id = R.id.trace }
    private var drawn: MissionReport? = null

    override val view: ScrollView =
        ScrollView(context).apply {
            isFillViewport = true
            addView(
                context.column().apply {
                    val gap = resources.getDimensionPixelSize(R.dimen.gap)
                    setPadding(gap, 0, gap, gap / 2)
                    below(reading)
                    below(corrected)
                    below(gradient)
                    below(trace, weight = 1f)
                },
            )
        }

    init {
        fill(null)
    }

    override fun show(snapshot: BoatSnapshot) {
        val report = snapshot.mission
        if (report === drawn && report != null) return
        drawn = report
        fill(report)
    }

    private fun fill(report: MissionReport?) {
        val probe = report?.spec?.probe
        val unit = probe?.quantity?.unit.orEmpty()
        val last = report?.trace?.lastOrNull()
        reading.say(
            if (probe == null || last == null) {
                context.getString(R.string.trace_no_reading)
            } else {
                context.getString(
                    R.string.trace_reading,
                    context.getString(probe.quantity.words()),
                    last.reading,
                    unit,
                ).trim()
            },
        )
        corrected.say(last?.let { believed(it, unit, probe?.range) })
        gradient.say(
            last?.let { point ->
                point.gradient?.takeIf { it.isFinite() }?.let { context.getString(R.string.trace_slope, it, unit) }
                    ?: context.getString(R.string.trace_no_slope)
            },
        )
        trace.scene = TraceScene(report?.trace.orEmpty().map(::moment), unit)
    }

    private fun believed(point: TracePoint, unit: String, range: Interval?): String {
        val value = point.corrected ?: return context.getString(R.string.trace_no_cell)
        val (lower, upper) = (point.lower ?: Double.NaN) to (point.upper ?: Double.NaN)
        return context.getString(R.string.trace_corrected, value, unit, context.boundsWords(lower, upper, range))
    }

    private fun moment(point: TracePoint) =
        TraceMoment(
            point.seconds,
            point.reading,
            point.gradient ?: Double.NaN,
            point.cell ?: Grid.OUTSIDE,
            point.corrected ?: Double.NaN,
            point.lower ?: Double.NaN,
            point.upper ?: Double.NaN,
        )
}
