package stillwater.report

import com.github.ajalt.mordant.rendering.BorderType
import com.github.ajalt.mordant.rendering.TextAlign
import com.github.ajalt.mordant.rendering.TextStyles
import com.github.ajalt.mordant.rendering.Widget
import com.github.ajalt.mordant.table.Borders
import com.github.ajalt.mordant.table.table

/**
 * This table as a mordant widget, for `terminal.println(...)`: header in bold over one rule, no other lines, numbers
 * to the right. The terminal decides about colour and width.
 *
 * @param title shown above the table; none if empty.
 */
public fun Table.toTerminal(title: String = ""): Widget = table {
    borderType = BorderType.SQUARE
    tableBorders = Borders.NONE
    cellBorders = Borders.NONE
    if (title.isNotEmpty()) captionTop(title, align = TextAlign.LEFT)
    columns.forEachIndexed { index, column ->
        column(index) { align = if (column.align == Align.RIGHT) TextAlign.RIGHT else TextAlign.LEFT }
    }
    header {
        style = TextStyles.bold.style
        cellBorders = Borders.BOTTOM
        rowFrom(columns.map { it.header })
    }
    body { rows.forEach { rowFrom(it) } }
}
