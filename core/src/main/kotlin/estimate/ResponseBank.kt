package stillwater.estimate

/**
 * Seven Kalman filters of one [ResponseBankKind] at six pairs of its two parameters: the middle, a step either way in
 * each, and one either way in both. What they say, misfit and truth of every cell, is a quadratic in the two
 * parameters.
 *
 * As [LagBank], with the sensor as two lags in a row (the second without time where there is only one), the water seen
 * with a dead time, and each visit followed twice where rising and falling differ. Scaled values; variances over the
 * noise's. Derivation: core/docs/SelfCalibratingEstimator.md, section "Other sensors". O(1) a reading, no allocation
 * once the cells' memory has grown.
 */
internal class ResponseBank : ReadingPlayer {
    override val filters: Int get() = nodes * kind.branches
    private val bank = ResponseFilter()
    private var memory = DoubleArray(FIRST_SLOTS * SLOT)

    /** Entries into cells that the delayed water has not reached yet: when, and where to. */
    private val entryTimes = DoubleArray(PENDING)

    /** When the boat was there at the latest. */
    private val entryEnds = DoubleArray(PENDING)
    private val entrySlots = IntArray(PENDING)
    private val entryBranches = IntArray(PENDING)
    private var entries = 0
    private val reached = IntArray(NODES)
    private val clocks = DoubleArray(NODES)
    private val current = IntArray(NODES)
    private val previous = IntArray(NODES)
    private val delays = DoubleArray(NODES)
    private var lastSlot = LagBank.NONE
    private var lastSeconds = Double.NaN
    private var nodes = NODES
    private var priorVariance = 1.0
    private var visitVariance = 1.0
    private var stateBefore = 0.0

    /** What kind of sensor the filters assume. */
    var kind: ResponseBankKind = ResponseBankKind.ASYMMETRIC
        private set

    /** First parameter of the middle filter. */
    var first: Double = 0.0
        private set

    /** Second parameter of the middle filter. */
    var second: Double = 0.0
        private set

    /** Distance of the outer filters in the first parameter. */
    var firstStep: Double = 1.0
        private set

    /** Distance of the outer filters in the second parameter. */
    var secondStep: Double = 1.0
        private set

    /** Whether visits begin with the prior that all kinds have in common, so that their misfits compare, from [reset] on. */
    var comparesKinds: Boolean = false

    /** Readings, and agreements between visits, beyond the numbers fitted to them. */
    var freedom: Double = 0.0
        private set

    /** What of [misfit] of the middle filter is disagreement between visits, and how many agreements that is of. */
    private var pooledMisfit = 0.0
    private var agreements = 0

    /** Variance left within visits at the middle filter, scaled, whatever they disagree. */
    val varianceWithin: Double get() = (misfit(0) - pooledMisfit) / (freedom - agreements)

    /** Slot of the cell whose water the sensor sees at the middle filter, [LagBank.NONE] if not known. */
    val here: Int get() = maxOf(current[0], LagBank.NONE)

    /** Slot of the cell before [here]. */
    val before: Int get() = maxOf(previous[0], LagBank.NONE)

    /** Sum of the products of successive scaled innovations at the middle. */
    val succession: Double get() = bank.succession(branch())

    /** Forgets all and takes [kind] with these parameters and steps; [noise] is the noise's variance, scaled. */
    fun reset(
        kind: ResponseBankKind,
        first: Double,
        firstStep: Double,
        second: Double,
        secondStep: Double,
        noise: Double,
    ) {
        this.kind = kind
        this.first = first
        this.second = second
        this.firstStep = firstStep
        this.secondStep = secondStep
        nodes = NODES
        priorVariance = 1 / maxOf(noise, LagBank.LEAST_RATIO)
        for (i in 0 until NODES) {
            val one = first + firstStep * FIRST_PLACE[i]
            val other = second + secondStep * SECOND_PLACE[i]
            delays[i] = kind.deadTime(other)
            for (branch in 0..1) {
                bank.set(i, branch, kind.timeConstant(one, other, branch), kind.secondLag(one, other))
            }
        }
        val flatness = if (comparesKinds) 1.0 else kind.flatness
        visitVariance = maxOf(priorVariance, minOf(flatness * priorVariance, 1 / LagBank.LEAST_RATIO))
        bank.clear(kind.lags, visitVariance)
        memory.fill(0.0)
        freedom = 0.0
        pooledMisfit = 0.0
        agreements = 0
        idle()
    }

    /** As [reset], the middle filter only. */
    fun resetMiddle(kind: ResponseBankKind, first: Double, second: Double, noise: Double) {
        reset(kind, first, 1.0, second, 0.0, noise)
        nodes = 1
    }

    private fun idle() {
        lastSlot = LagBank.NONE
        entries = 0
        reached.fill(0)
        current.fill(LagBank.NONE)
        previous.fill(LagBank.NONE)
    }

    override fun leave() {
        if (lastSlot == LagBank.NONE) return
        val chosen = branch()
        for (i in 0 until nodes) {
            bank.choose(i, chosen)
            pool(i, previous[i], before = true)
            pool(i, current[i], before = false)
        }
        idle()
    }

    /** Equal slots in a row are one visit. */
    override fun take(slot: Int, seconds: Double, value: Double) {
        if (lastSlot == LagBank.NONE) {
            for (i in 0 until nodes) {
                bank.begin(i)
                current[i] = ELSEWHERE
                clocks[i] = seconds
            }
            stateBefore = value
            freedom -= kind.lags
            push(slot, seconds, seconds)
        } else if (slot != lastSlot) {
            push(slot, lastSeconds, lastSeconds)
        }
        lastSlot = slot
        lastSeconds = seconds
        for (i in 0 until nodes) {
            while (reached[i] < entries) {
                val entry = reached[i] % PENDING
                val at = entryTimes[entry] + delays[i]
                val end = entryEnds[entry] + delays[i]
                val isFull = entries - reached[i] == PENDING
                if (at >= seconds && !isFull) break
                advance(i, minOf(at, seconds))
                advance(i, minOf(end, seconds), isBlurred = true)
                if (end >= seconds && !isFull) break
                enter(i, entry)
            }
            advance(i, seconds)
            for (branch in 0 until kind.branches) bank.correct(i, branch, value)
        }
        freedom++
    }

    override fun enter(slot: Int, from: Double, until: Double) {
        push(slot, from, until)
        lastSlot = slot
    }

    private fun push(slot: Int, from: Double, until: Double) {
        entryTimes[entries % PENDING] = from
        entryEnds[entries % PENDING] = until
        entrySlots[entries % PENDING] = slot
        entries++
    }

    /** Brings filter [i] on to [time], the water seen being the present cell's or, [isBlurred], that or the next one's. */
    private fun advance(i: Int, time: Double, isBlurred: Boolean = false) {
        val elapsed = time - clocks[i]
        if (!(elapsed > 0)) return
        clocks[i] = time
        for (branch in 0 until kind.branches) bank.predict(i, branch, elapsed)
        if (!isBlurred) return
        for (branch in 0 until kind.branches) bank.blur(i, branch, priorVariance)
        if (i == 0) freedom -= bank.blurred
    }

    private fun enter(i: Int, entry: Int) {
        // The middle filter decides for all whether the visit was a rise or a fall.
        if (i == 0) entryBranches[entry] = branch()
        bank.choose(i, entryBranches[entry])
        if (i == 0) stateBefore = bank.state(0, 0)
        pool(i, previous[i], before = true)
        bank.enter(i)
        previous[i] = current[i]
        current[i] = entrySlots[entry]
        if (i == 0) freedom--
        reached[i]++
    }

    /** Whether the visit at the middle filter is a rise (0) or a fall (1): which of the two agrees with itself. */
    private fun branch(): Int {
        if (kind.branches == 1) return 0
        val rises = bank.truth(0, 0) >= stateBefore
        val falls = bank.truth(0, 1) < stateBefore
        return when {
            rises != falls -> if (rises) 0 else 1
            else -> if (bank.misfit(0, 0) <= bank.misfit(0, 1)) 0 else 1
        }
    }

    /** Sum of squared innovations over their variances at filter [i]. */
    fun misfit(i: Int): Double = bank.misfit(i, branch())

    /** What [misfit] of the middle filter will never be below again. */
    fun leastMisfit(): Double =
        if (kind.branches == 1) bank.misfit(0, 0) else minOf(bank.misfit(0, 0), bank.misfit(0, 1))

    /** The scaled truth of the cell with [slot] at filter [i]. */
    fun truth(slot: Int, i: Int): Double {
        var sum = 0.0
        if (isRemembered(slot)) sum = memory[slot * SLOT + 2 * i] * memory[slot * SLOT + 2 * i + 1]
        val branch = branch()
        if (slot == current[i]) sum += bank.truth(i, branch) / bank.variance(i, branch)
        if (slot == previous[i]) sum += bank.truthBefore(i, branch) / bank.varianceBefore(i, branch)
        return sum / information(slot, i)
    }

    /** The information on the truth of the cell with [slot] at filter [i], over the noise's variance. */
    fun information(slot: Int, i: Int): Double {
        var information = if (isRemembered(slot)) memory[slot * SLOT + 2 * i + 1] else 0.0
        val own = 1 / visitVariance
        val branch = branch()
        if (slot == current[i]) information += 1 / bank.variance(i, branch) - own
        if (slot == previous[i]) information += 1 / bank.varianceBefore(i, branch) - own
        return information + 1 / priorVariance
    }

    /** Whether there is memory for it: of no information where nothing was pooled, which a filter does when it is due there. */
    private fun isRemembered(slot: Int) = (slot + 1) * SLOT <= memory.size

    /** Pools the visit to [slot] that filter [i] is in, or was in before, with the cell's others. */
    private fun pool(i: Int, slot: Int, before: Boolean) {
        if (slot < 0) return
        while (memory.size < (slot + 1) * SLOT) memory = memory.copyOf(2 * memory.size)
        val at = slot * SLOT + 2 * i
        val spread = if (before) bank.varianceBefore(i, 0) else bank.variance(i, 0)
        val mean = if (before) bank.truthBefore(i, 0) else bank.truth(i, 0)
        val information = maxOf(1 / spread - 1 / visitVariance, LEAST_INFORMATION)
        val truth = mean / spread / information
        val known = memory[at + 1]
        if (known > 0) {
            val gap = truth - memory[at]
            val misfit = gap * gap / (1 / information + 1 / known)
            bank.addMisfit(i, misfit)
            if (i == 0) {
                freedom++
                pooledMisfit += misfit
                agreements++
            }
        }
        memory[at] += information / (known + information) * (truth - memory[at])
        memory[at + 1] = known + information
    }

    companion object {
        /** The middle, either side of it in the first parameter, in the second, and in both. */
        const val NODES = 7

        /** Where the filters lie, in steps of the first parameter. */
        private val FIRST_PLACE = doubleArrayOf(0.0, -1.0, 1.0, 0.0, 0.0, -1.0, 1.0)

        /** Where they lie in steps of the second. */
        private val SECOND_PLACE = doubleArrayOf(0.0, 0.0, 0.0, -1.0, 1.0, -1.0, 1.0)

        /** Where the water of the first dead time came from. */
        private const val ELSEWHERE = -2

        /** Cells that the boat may pass within the dead time. */
        private const val PENDING = 64
        private const val SLOT = 2 * NODES
        private const val FIRST_SLOTS = 128
        private const val LEAST_INFORMATION = 1e-9
    }
}
