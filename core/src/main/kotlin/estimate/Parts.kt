package stillwater.estimate

import kotlin.coroutines.Continuation
import kotlin.coroutines.EmptyCoroutineContext
import kotlin.coroutines.createCoroutine
import kotlin.coroutines.intrinsics.COROUTINE_SUSPENDED
import kotlin.coroutines.intrinsics.suspendCoroutineUninterceptedOrReturn
import kotlin.coroutines.resume

/**
 * A computation that is done in parts: it says what it has done with [spend], and rests there once a part is used up.
 *
 * What it computes does not depend on where it rests. Each [begin] allocates, and each rest a little. Confined to one
 * thread.
 */
internal class Parts {
    private var rest: Continuation<Unit>? = null
    private var left = 0.0

    /** Whether something was begun and is not complete. */
    val isBusy: Boolean get() = rest != null

    /** Begins [task], nothing of which is done before [go]; no other may be under way. */
    fun begin(task: suspend () -> Unit) {
        check(!isBusy) { "a computation is under way" }
        rest = task.createCoroutine(
            object : Continuation<Unit> {
                override val context get() = EmptyCoroutineContext

                // What the task throws is thrown at who goes on with it.
                override fun resumeWith(result: Result<Unit>) = result.getOrThrow()
            },
        )
    }

    /** Goes on until [most] is spent or the task is complete. */
    fun go(most: Double) {
        left = most
        val task = rest ?: return
        rest = null
        task.resume(Unit)
    }

    /** For the task: [work] was done, in whatever unit [go]'s is. */
    suspend fun spend(work: Double) {
        left -= work
        if (left > 0) return
        suspendCoroutineUninterceptedOrReturn { task ->
            rest = task
            COROUTINE_SUSPENDED
        }
    }
}
