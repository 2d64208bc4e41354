/** @file
 * Scenes, plans, and what there is on this machine. Included by pointspec.h.
 */
#ifndef POINTSPEC_COMMANDS_H
#define POINTSPEC_COMMANDS_H

#include "pointspec/answer.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Scenes, plans, devices
 *
 * Options are given as to pspec_answer(); what comes is the table of the command of the same name.
 * @{ */

/** Runs a scene, the only value of the option "files": all results into the folder "output", by
 * default that of the name of the scene, as pointspec run; with "cache" and "no-skip". *out says of
 * each result how many questions it had and how many of them the cache answered. That a record is
 * not repeated or a check finds another spectrum is no error, but the verdict of the table.
 * Progress and cancelling are by the context's callback, warnings go to that for warnings. Errors
 * have file and line in front. */
PSPEC_EXPORT pspec_status pspec_run(pspec_table **out, pspec_context *context,
                                    const pspec_option *options, size_t num_options);

/** What a command would do, as pointspec plan: every engine with its seconds, bytes and error, the
 * one chosen and why the others were not; header entries say what is skipped and how long each
 * phase takes. command: a kind of answer, "sample", "convert" or "run"; options: its own. Nothing
 * is computed, timed or written. */
PSPEC_EXPORT pspec_status pspec_plan_table(pspec_table **out, pspec_context *context,
                                           const char *command, const pspec_option *options,
                                           size_t num_options);

/** The OpenCL devices, as pointspec devices; the column "default" is 1 for the one that the context
 * has or would open. Where there is none the table has no rows, and the callback for warnings hears
 * why. */
PSPEC_EXPORT pspec_status pspec_devices(pspec_table **out, pspec_context *context);

/** What works on this machine and what does not, as pointspec doctor: columns finding ("ok", "note"
 * or "WRONG"), topic and sentence. That the default device is not in order is the verdict of the
 * table. Computes one spectrum of four points on every device. */
PSPEC_EXPORT pspec_status pspec_doctor(pspec_table **out, pspec_context *context);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
