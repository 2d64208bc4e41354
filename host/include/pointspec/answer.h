/** @file
 * Answers of every kind of answer, from files or samplers, as the program gives them. Included by
 * pointspec.h.
 */
#ifndef POINTSPEC_ANSWER_H
#define POINTSPEC_ANSWER_H

#include "pointspec/table.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Answers
 *
 * What a command of the program prints is asked for here by the same words: options by their long
 * names, without dashes, and their values as texts. So the manual page of each command says what
 * there is; a table of the options comes from pspec_options_table(). The answer is that of the
 * program to the bit: the same engine, the same header, the same rows.
 *
 *     const pspec_option options[] = {{"sampler", "jittered"}, {"points", "1024"}, {"bins", "floor"}};
 *     pspec_answer(&table, context, "power", options, 3);
 *
 * Device, memory limit, progress and cancelling are those of the context. The folder of measured
 * figures and of the cache of results is that of the environment, as for the program. Point files
 * are values of the option "files", which may be given several times. Nothing is read from standard
 * input or written to standard output: "-" is no file here.
 * @{ */

/** An option and its value: both are borrowed for the call. */
typedef struct pspec_option {
    const char *name;  /**< "points" for --points, or "files" */
    const char *value; /**< as a word of a command line; of flags "true", "false", or NULL: true */
} pspec_option;

/** The kinds of answers, "power", "angular", ...: i from 0 on, NULL behind the last. Static
 * storage. */
PSPEC_EXPORT const char *pspec_answer_kind(size_t i);

/** The options that a command takes here, as a table with the columns option, values (missing for
 * flags), type ("flag", "integer", "integers", "number", "word" of those of values, or "text"),
 * unit (missing: none), default (as help says it; missing: none), repeated ("yes" where each of
 * several counts), file ("read" or "written" where a value names one; else missing), kinds (of
 * answers that take it, with commas) and help. command: a kind of answer, "sample", "convert" or "run".
 * #PSPEC_ERROR_INVALID_ARGUMENT names the nearest command where there is no such one. */
PSPEC_EXPORT pspec_status pspec_options_table(pspec_table **out, pspec_context *context,
                                              const char *command);

/** What answers of a kind have, as a table with a row for every header entry, column and array that
 * there may be, and the columns field (its name), group ("entry", "column" or "array", which is a
 * file of its own), unit (missing: none), repeated ("yes" where the key of an entry may come
 * several times, as for several samplers, else "no"), when (the options or cases in which it is
 * there; missing: always) and meaning. kind: pspec_answer_kind() lists them;
 * or "plan", "devices".
 * #PSPEC_ERROR_INVALID_ARGUMENT names the nearest kind where there is no such one. */
PSPEC_EXPORT pspec_status pspec_fields_table(pspec_table **out, pspec_context *context,
                                             const char *kind);

/** Answers a question of a kind of answer, as "power" or "check": pspec_answer_kind() lists them.
 * Rows and columns of *out are those of the table that the program's command of that name prints.
 *
 * Files that the options name are written, too: "output" (the table, "format" as in
 * pspec_table_write()), "plot" (a picture, by gnuplot), "full" of power (float64 [2K+1]...[2K+1]),
 * "coefficients" of power and angular (complex128, as pspec_plan_coefficients()) and "weights-out"
 * of quadrature (the weights of the only rule).
 *
 * #PSPEC_ERROR_INVALID_ARGUMENT: an option that the kind does not take, a value that cannot be
 * meant, options that do not go together. #PSPEC_ERROR_INPUT: points or files that cannot be used.
 * #PSPEC_ERROR_TOLERANCE and #PSPEC_ERROR_MEMORY as pspec_plan_create(). #PSPEC_ERROR_CANCELLED:
 * the progress callback asked to stop. That a check finds another spectrum is no error: see
 * pspec_table_verdict(). */
PSPEC_EXPORT pspec_status pspec_answer(pspec_table **out, pspec_context *context, const char *kind,
                                       const pspec_option *options, size_t num_options);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
