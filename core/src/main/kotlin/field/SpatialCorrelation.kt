package stillwater.field

/** How alike the field is believed to be in two cells of one map, before either is measured. */
public fun interface SpatialCorrelation {
    /**
     * Correlation of the values of two cells, −1 to 1, dimensionless; 1 for a cell with itself. No allocation.
     *
     * @param columns columns from one to the other, either sign.
     * @param rows rows from one to the other, either sign.
     */
    public fun between(columns: Int, rows: Int): Double
}
