package stillwater.app.setup

import android.content.Context
import android.content.Intent
import android.view.View
import android.widget.Button
import android.widget.LinearLayout
import android.widget.ScrollView
import stillwater.app.R
import stillwater.app.screen.ChoiceField
import stillwater.app.screen.DocumentPurpose
import stillwater.app.screen.FieldColumn
import stillwater.app.screen.Screen
import stillwater.app.screen.ScreenHost
import stillwater.app.screen.ScreenName
import stillwater.app.screen.TextField
import stillwater.app.screen.below
import stillwater.app.screen.heading
import stillwater.app.screen.largeButton
import stillwater.app.screen.liveLine
import stillwater.app.screen.perSecond
import stillwater.app.screen.row
import stillwater.app.screen.say
import stillwater.app.screen.scrolling
import stillwater.app.service.BoatSnapshot
import stillwater.mission.DraftField
import stillwater.mission.EstimatorName
import stillwater.mission.FailsafeSpec
import stillwater.mission.MissionDraft
import stillwater.mission.MissionSpec
import stillwater.mission.PlannerName
import stillwater.mission.Quantity

/**
 * Fills in a mission, without a network: what is wrong stands under the field where it is, in core's words.
 *
 * @param onUse takes the mission once it is whole and a person wants it.
 */
internal class SetupScreen(
    private val context: Context,
    private val host: ScreenHost,
    private val onUse: (MissionSpec) -> Unit,
) : Screen {
    private val desk get() = host.desk
    private val said = context.liveLine().apply { id = R.id.document_said }
    private val name =
        TextField(context, context.getString(R.string.field_name), isNumber = false, R.id.mission_name) { text ->
            desk.change { it.with(DraftField.NAME, text) }
        }
    private val numbers = DraftField.NUMBERS.associateWith { field ->
        TextField(context, "", isNumber = true) { text -> desk.change { it.with(field, text) } }
    }
    private val area = AreaField()
    private val quantity =
        choice(R.string.field_quantity, Quantity.entries, Quantity::words) { measuring(it) }
    private val estimator =
        choice(R.string.field_estimator, EstimatorName.entries, EstimatorName::words) { copy(estimator = it) }
    private val planner =
        choice(R.string.field_planner, PlannerName.entries, PlannerName::words) { copy(planner = it) }
    private val unit = choice(R.string.field_budget_unit, listOf(false, true), ::unitWords) { copy(isTimed = it) }
    private val onBattery = failsafe(R.string.field_on_battery) { copy(onBattery = it) }
    private val onFence = failsafe(R.string.field_on_fence) { copy(onFence = it) }
    private val atEnd = failsafe(R.string.field_at_end) { copy(atEnd = it) }
    private val rearms = choice(R.string.field_rearms, listOf(true, false), ::rearmWords) { copy(rearms = it) }
    private val toMend = context.liveLine().apply { setTextColor(context.getColor(R.color.bad)) }
    private val use: Button = context.largeButton(context.getString(R.string.use_mission), ::use).apply {
        id = R.id.use_mission
    }

    override val view: ScrollView = context.scrolling { form() }.apply { id = R.id.setup }

    override fun opened() = refresh()

    override fun show(snapshot: BoatSnapshot) = Unit

    /** Tells what became of a document. */
    fun say(words: String?) = said.say(words)

    /** Shows the draft as it is. */
    fun refresh() {
        val draft = desk.draft
        name.fill(draft.name)
        for ((field, column) in numbers) {
            val unit = unitOf(field, draft)
            val words = context.getString(field.words())
            column.rename(if (unit.isEmpty()) words else context.getString(R.string.field_unit, words, unit))
            column.fill(draft.text(field))
        }
        quantity.fill(draft.quantity)
        estimator.fill(draft.estimator)
        planner.fill(draft.planner)
        unit.fill(draft.isTimed)
        onBattery.fill(draft.onBattery)
        onFence.fill(draft.onFence)
        atEnd.fill(draft.atEnd)
        rearms.fill(draft.rearms)
        use.isEnabled = desk.isChecked && desk.check?.spec != null
        if (!desk.isChecked) return
        val check = desk.check ?: return
        area.summary.say(context.areaSummary(draft, check))
        area.problem(check.problems[DraftField.AREA] ?: check.problems[DraftField.HOME])
        name.problem(check.problems[DraftField.NAME])
        planner.problem(check.problems[DraftField.PLANNER])
        for ((field, column) in numbers) column.problem(check.problems[field])
        val count = check.problems.size
        toMend.say(if (count == 0) null else context.resources.getQuantityString(R.plurals.to_mend, count, count))
    }

    private inner class AreaField : FieldColumn(context, context.getString(R.string.field_area)) {
        val summary = context.liveLine()

        init {
            val open = context.largeButton(context.getString(R.string.draw_area)) { host.open(ScreenName.AREA) }
            open.id = R.id.draw_area
            below(summary)
            below(open)
            addProblemLine()
        }
    }

    private fun LinearLayout.form() {
        below(
            context.row(
                documentButton(R.string.load_mission, R.id.load_mission) { host.choose(OPEN, DocumentPurpose.MISSION) },
                documentButton(R.string.save_mission, R.id.save_mission, ::save),
            ),
        )
        below(said)
        below(name)
        part(R.string.field_area, area, numbers.getValue(DraftField.CELL))
        part(R.string.part_probe, quantity)
        numbers(DraftField.LOWEST, DraftField.HIGHEST, DraftField.SLOWEST, DraftField.LATENCY)
        numbers(DraftField.PORT, DraftField.LARGEST_JUMP, DraftField.STUCK_AFTER)
        numbers(DraftField.SMALLEST_SLOPE, DraftField.READING_ERROR)
        below(documentButton(R.string.load_probe, R.id.load_probe) { host.choose(OPEN, DocumentPurpose.PROBE) })
        part(R.string.part_method, estimator, planner)
        part(R.string.part_budget, unit)
        numbers(DraftField.BUDGET, DraftField.RESERVE)
        part(R.string.part_failsafe, onBattery)
        numbers(DraftField.LOWEST_VOLTS, DraftField.LOWEST_PHONE)
        below(onFence)
        below(atEnd)
        below(rearms)
        part(R.string.part_boat)
        numbers(DraftField.TOP_SPEED, DraftField.CRUISE, DraftField.ARRIVAL)
        below(toMend)
        below(use)
    }

    private fun LinearLayout.part(title: Int, vararg fields: View) {
        below(context.heading(context.getString(title)))
        fields.forEach { below(it) }
    }

    private fun LinearLayout.numbers(vararg fields: DraftField) = fields.forEach { below(numbers.getValue(it)) }

    private fun documentButton(words: Int, id: Int, action: () -> Unit): Button =
        context.largeButton(context.getString(words), action).also { it.id = id }

    /** One of [options] to choose, which makes of the draft what [change] does. */
    private fun <T> choice(
        name: Int,
        options: List<T>,
        words: (T) -> Int,
        change: MissionDraft.(T) -> MissionDraft,
    ): ChoiceField<T> =
        ChoiceField(context, context.getString(name), options.map { it to context.getString(words(it)) }) { picked ->
            desk.change { it.change(picked) }
        }

    private fun failsafe(name: Int, change: MissionDraft.(FailsafeSpec) -> MissionDraft) =
        choice(name, FailsafeSpec.entries, FailsafeSpec::words, change)

    private fun unitOf(field: DraftField, draft: MissionDraft): String =
        when (field) {
            DraftField.LOWEST, DraftField.HIGHEST, DraftField.LARGEST_JUMP, DraftField.READING_ERROR ->
                draft.quantity.unit
            DraftField.SMALLEST_SLOPE -> context.perSecond(draft.quantity.unit)
            DraftField.BUDGET -> context.getString(if (draft.isTimed) R.string.unit_seconds else R.string.unit_metres)
            else -> field.unit
        }

    private fun save() {
        val spec = desk.check?.spec?.takeIf { desk.isChecked }
        if (spec == null) {
            say(context.getString(R.string.save_not_whole))
            return
        }
        val intent =
            Intent(Intent.ACTION_CREATE_DOCUMENT)
                .addCategory(Intent.CATEGORY_OPENABLE)
                .setType("application/json")
                .putExtra(Intent.EXTRA_TITLE, "${spec.name}.json")
        host.choose(intent, DocumentPurpose.SAVED_MISSION)
    }

    private fun use() {
        val spec = desk.check?.spec?.takeIf { desk.isChecked } ?: return
        onUse(spec)
    }

    private companion object {
        /** Any type: what a card reader or a mail program calls a JSON file is its own affair. */
        val OPEN: Intent
            get() = Intent(Intent.ACTION_OPEN_DOCUMENT).addCategory(Intent.CATEGORY_OPENABLE).setType("*/*")

        fun unitWords(isTimed: Boolean): Int = if (isTimed) R.string.budget_time else R.string.budget_way

        fun rearmWords(rearms: Boolean): Int = if (rearms) R.string.rearm_yes else R.string.rearm_no
    }
}
