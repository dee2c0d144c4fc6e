package stillwater.report

/** The program itself, as reports name it. */
public object Program {
    /** Its version, from the jar's manifest. */
    public val VERSION: String = Program::class.java.`package`.implementationVersion ?: "development"
}
