/** @file
 * Contexts: the device, limits, callbacks, and the sentence of the last error. Included by
 * pointspec.h.
 */
#ifndef POINTSPEC_CONTEXT_H
#define POINTSPEC_CONTEXT_H

#include "pointspec/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pspec_context pspec_context; /**< device, callbacks, limits, last error */

/** @name Context
 * @{ */

/** A context that has opened nothing yet, or NULL when there is no memory for it. */
PSPEC_EXPORT pspec_context *pspec_context_create(void);
/** Closes the device. The context's questions must be gone. NULL is allowed. */
PSPEC_EXPORT void pspec_context_destroy(pspec_context *context);

/** The sentence of the last call that failed; "" before. Valid until the next call with this
 * context or its questions. Of NULL: that there is no context. */
PSPEC_EXPORT const char *pspec_context_message(const pspec_context *context);

/** Which OpenCL device to use: an index, "cpu", "gpu", "accelerator" or a part of a name (copied);
 * NULL: the first GPU, else the first CPU. Several, "0,1", "gpu:all", "cpu:split=2", share the
 * realizations of power, angular and pairs, with the bits of one; other questions have the
 * first. Nothing is opened until a question needs a device; once one is open the choice is made,
 * and a call is #PSPEC_ERROR_INVALID_ARGUMENT. */
PSPEC_EXPORT pspec_status pspec_context_set_device(pspec_context *context, const char *selector);

/** The most memory in bytes that an answer may take, on host and device together, as the planner
 * counts it, and that patterns in memory may take beside it; 0, the default: no limit of yours.
 * Questions that are answered later obey it: with smaller batches, then another engine, else they
 * fail with #PSPEC_ERROR_MEMORY. What memory is free (also by limits of cgroups and of the process)
 * makes batches smaller, or an answer fails; the engine, and with it the bits of results, depends
 * on this limit alone. */
PSPEC_EXPORT void pspec_context_set_memory_limit(pspec_context *context, uint64_t bytes);

/** What is being done, and how far it is. Made by the library alone, which shows a pointer to it:
 * members are added at its end, and programs that know fewer of them stay right. */
typedef struct pspec_progress_report {
    /** What is counted: "realizations" that are in the averages, or the name of another
     * long phase, such as "weights: iterations of conjugate gradients". */
    const char *phase;
    uint64_t done;      /**< so many of them */
    uint64_t total;     /**< of so many; 0: not known */
    const char *detail; /**< a few words more, such as "residual 1e-07", or NULL */
} pspec_progress_report;

/** Is told how far the work is; texts are gone when it returns. Non-zero cancels the call that is
 * running, within a second. */
typedef int (*pspec_progress)(const pspec_progress_report *report, void *payload);

/** Calls progress after every batch, now and then inside a long one, and in every other phase that
 * takes long, in the thread that made the call; NULL: no longer. A callback must not use the
 * context or its questions. */
PSPEC_EXPORT void pspec_context_set_progress(pspec_context *context, pspec_progress progress,
                                             void *payload);

/** One sentence about what is being done, without a newline; gone when the callback returns. */
typedef void (*pspec_log)(const char *sentence, void *payload);

/** Calls log for every device that is opened and engine that is chosen; NULL: no longer. Sentences
 * are for people: they may change between versions. */
PSPEC_EXPORT void pspec_context_set_log(pspec_context *context, pspec_log log, void *payload);

/** Calls warn with sentences that are no errors and that the program says on standard error: work
 * that will take hours, a standard error that was not reached, a picture that could not be drawn;
 * NULL, the default: nobody is told. */
PSPEC_EXPORT void pspec_context_set_warnings(pspec_context *context, pspec_log warn, void *payload);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
