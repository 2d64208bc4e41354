/** @file
 * Questions, and what can be asked. Included by pointspec.h.
 */
#ifndef POINTSPEC_QUESTION_H
#define POINTSPEC_QUESTION_H

#include "pointspec/answer.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name What can be asked
 * @{ */

/** The kinds of answers, "power", "angular", ...: i from 0 on, NULL behind the last. Static
 * storage. */
PSPEC_EXPORT const char *pspec_answer_kind(size_t i);

/** The options that a kind of answer, or a command of pspec_question_create(), takes here, as an
 * answer with the columns option, values (missing for flags), type ("flag", "integer", "integers",
 * "number", "word" of those of values, or "text"), unit (missing: none), default (as help says it;
 * missing: none), repeated ("yes" where each of several counts), file ("read" or "written" where a
 * value names one; else missing), kinds (of answers that take it, with commas) and help.
 * #PSPEC_ERROR_INVALID_ARGUMENT names the nearest command where there is no such one. */
PSPEC_EXPORT pspec_status pspec_options_table(pspec_answer **out, pspec_context *context,
                                              const char *command);

/** What answers of a kind have, as an answer with a row for every header entry, column and array
 * that there may be, and the columns field (its name), group ("entry", "column" or "array"), unit
 * (missing: none), repeated ("yes" where the key of an entry may come several times, as for several
 * samplers, else "no"), when (the options or cases in which it is there; missing: always) and
 * meaning. kind: one of pspec_answer_kind(), "plan" or "devices". #PSPEC_ERROR_INVALID_ARGUMENT
 * names the nearest kind where there is no such one. */
PSPEC_EXPORT pspec_status pspec_fields_table(pspec_answer **out, pspec_context *context,
                                             const char *kind);

/** What pictures of answers of a kind have, for who draws them by other means: a row for every line
 * of a picture (number from 0 on), with the fields that it is made of: x, y, error (bars up and
 * down), low and high (a band), panels (a panel for each of its values; these missing where there
 * are none), entries ("yes" where x and y are header entries of several questions, else "no"), look
 * ("line", "curve", "marks", "signs", "bound", "cloud", "reference" or "front"), name (in the key,
 * beside that of the curve; missing: that alone), and log_x and log_y ("yes" or "no"). A curve is
 * that of a sampler, or of what else the columns before x tell apart. Arrays that stand beside the
 * lines, or are the picture, have rows, too, without x: look is "points" (a set in the unit square),
 * "plane" (frequencies, 0 in the middle), "pixels" (from 0 to 1, or of both signs) or "light", one
 * image or several.
 * kind: as for pspec_fields_table(). */
PSPEC_EXPORT pspec_status pspec_pictures_table(pspec_answer **out, pspec_context *context,
                                               const char *kind);

/** @}
 * @name Questions
 *
 * A question is asked by the words of the program: options by their long names, without dashes, and
 * their values as texts, numbers or arrays. So the manual page of each command says what there is.
 * Points are those of samplers and files, as for the program, or of the caller: patterns in memory,
 * or a function that makes them. Every kind of answer takes either.
 *
 *     pspec_question_create(&question, context, "power");
 *     pspec_question_set(question, "bins", "floor");
 *     pspec_question_add(question, 100, 1024, 2, points, NULL);
 *     pspec_question_answer(&answer, question);
 *
 * The answer is that of the program to the bit: the same engine, the same header, the same rows.
 * Device, memory limit, progress and cancelling are those of the context. The folder of measured
 * figures and of caches is that of the environment, as for the program. Nothing is read from
 * standard input or written to standard output: "-" is no file here.
 *
 * A question may be asked again, with more options and more patterns. Arguments are borrowed for
 * the call alone: texts, numbers and patterns are copied, but functions and their payloads are
 * called until the question is destroyed or reset.
 * @{ */

typedef struct pspec_question pspec_question; /**< options, and patterns so far */

/** A question without options. kind: one of pspec_answer_kind(), or one of these commands:
 *
 * - "sample": points of a sampler. The answer has them as the array coordinates [M][N][d], unless
 *   the option "output" names a file for them.
 * - "convert": point files, or patterns in memory, into the file "output" in another format.
 * - "run": a scene, the only value of the option "files": all results into the folder "output". The
 *   answer says of each result how many questions it had and how many of them the cache answered.
 * - "devices": the OpenCL devices; the column default is 1 for the one that would be used.
 * - "doctor": what works on this machine and what does not; the verdict says what is wrong with the
 *   default device.
 *
 * #PSPEC_ERROR_INVALID_ARGUMENT names the nearest kind where there is no such one. */
PSPEC_EXPORT pspec_status pspec_question_create(pspec_question **out, pspec_context *context,
                                                const char *kind);
/** Forgets all patterns, and functions that make them. Options stay. */
PSPEC_EXPORT void pspec_question_reset(pspec_question *question);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_question_destroy(pspec_question *question);

/** Sets an option, "points" for --points: value is a word of a command line, and of flags "true",
 * "false", or NULL, which is true. "files" is the option of point files, and may be given several
 * times; other options that the program takes once are set anew. Files that options name are
 * written whenever the question is answered: "output" (the table, "format" as in
 * pspec_answer_write()), "plot" (a picture, by gnuplot), "full" and "coefficients" of spectra,
 * "weights-out" of quadrature. The last three may be NULL: then the answer has the array, and there
 * is no file. "state", which is no option of the program, is NULL: the answer has the sums that
 * pspec_answer_merge() needs, as NPZ files of spectra have.
 *
 * #PSPEC_ERROR_INVALID_ARGUMENT: the kind does not take the option, or the value cannot be meant;
 * the option is then as it was. */
PSPEC_EXPORT pspec_status pspec_question_set(pspec_question *question, const char *option,
                                             const char *value);
/** The same for a number, which is kept to the bit. */
PSPEC_EXPORT pspec_status pspec_question_set_number(pspec_question *question, const char *option,
                                                    double value);
/** Sets an option whose value names a file of numbers to numbers in memory, which are copied: the
 * option "frequencies" to integers [num][d], "weights" to those of every set [N], "brdf" and
 * "integrand" to a table of the kind that the name of the field says, "zonal", "coefficients" or
 * "pixels". #PSPEC_F64, #PSPEC_I64 and #PSPEC_C128 are numbers. */
PSPEC_EXPORT pspec_status pspec_question_set_array(pspec_question *question, const char *option,
                                                   const pspec_field *array);

/** Patterns that are added from now on are realizations of another average, a curve of that name
 * beside those of samplers and files, as for --set of the program. A name that comes again is that
 * curve with the next of several numbers of points, as the option "points" names them. */
PSPEC_EXPORT pspec_status pspec_question_begin_set(pspec_question *question, const char *name);

/** Adds realizations: points [num_patterns][num_points][dimension], each coordinate in [0,1), or
 * unit vectors (dimension 3; lengths may be off by 1e-6), and weights [num_patterns][num_points],
 * real, finite, of either sign, or NULL: all 1. Other calls may add other numbers of points. The
 * answer depends on the patterns and their order alone, to the bit, not on how they are divided
 * into calls. Points are looked at when the question is answered.
 *
 * All are copied, and kept until pspec_question_reset(). #PSPEC_ERROR_MEMORY: they take more than
 * the memory limit of the context, or than there is; pspec_question_give() keeps none. */
PSPEC_EXPORT pspec_status pspec_question_add(pspec_question *question, size_t num_patterns,
                                             size_t num_points, unsigned dimension,
                                             const double *points, const double *weights);

/** The same without a copy: points and weights stay where they are and as they are until
 * pspec_question_reset() or pspec_question_destroy(), and no limit counts them. */
PSPEC_EXPORT pspec_status pspec_question_borrow(pspec_question *question, size_t num_patterns,
                                                size_t num_points, unsigned dimension,
                                                const double *points, const double *weights);

/** Makes *out a view of pattern number `realization`, from 0 on, that stays as it is until the next
 * call, and returns 1; or returns 0 where there are no more; or anything below 0, which ends the
 * work with #PSPEC_ERROR_INPUT. *out has only zeros before. It is called by the thread that asks,
 * one at a time, in the order of the realizations, from 0 on whenever they are read again, and has
 * to answer alike then. A seed of its own stands in the payload: the option "seed" is not passed
 * on. It must not use the context or the question. */
typedef int (*pspec_give)(uint64_t realization, pspec_pattern *out, void *payload);

/** The patterns of the set are those that give makes, at most num of them; 0: until there are no
 * more. Nothing is kept of them but what an average needs, and nothing is cached.
 * #PSPEC_ERROR_INVALID_ARGUMENT where the set has others already. */
PSPEC_EXPORT pspec_status pspec_question_give(pspec_question *question, uint64_t num,
                                              pspec_give give, void *payload);

/** Fills values [num] with those of an integrand at points [num][dimension], and returns 0;
 * anything else ends the work with #PSPEC_ERROR_INPUT. It is called by the thread that asks, some
 * hundred points at a time, has to answer alike for the same points, and must not use the context
 * or the question. */
typedef int (*pspec_values)(size_t num, unsigned dimension, const double *points, double *values,
                            void *payload);

/** Adds an integrand of the caller, as the option "integrand" of variance adds one of the
 * program's, with its integral over the torus, the sphere (of area 4 pi) or the hemisphere (2 pi).
 * Its variance is measured; what is known from spectra alone, such as predicted, is missing. */
PSPEC_EXPORT pspec_status pspec_question_integrand(pspec_question *question, const char *name,
                                                   double integral, pspec_values values,
                                                   void *payload);

/** What answering would take, as pointspec plan: every engine with its seconds, bytes and error,
 * the one chosen and why the others were not; header entries say what is skipped and how long each
 * phase takes. Nothing is computed, timed or written. */
PSPEC_EXPORT pspec_status pspec_question_plan(pspec_answer **out, pspec_question *question);

/** Answers the question of all patterns so far.
 *
 * Plan, frequencies and buffers of "power", "angular" and "pairs" stay with the question: after
 * pspec_question_reset() and pspec_question_add() of as many patterns of the same size an answer
 * costs no more than its sums, and has the bits of a new question's. A change of options gives
 * their memory back, and so does pspec_question_destroy().
 *
 * #PSPEC_ERROR_INVALID_ARGUMENT: options that do not go together. #PSPEC_ERROR_INPUT: points or
 * files that cannot be used; the sentence names the set (from 1) and the point.
 * #PSPEC_ERROR_TOLERANCE: no engine reaches the tolerance. #PSPEC_ERROR_MEMORY: none fits the
 * memory limit of the context, or the memory. #PSPEC_ERROR_CANCELLED: the progress callback asked
 * to stop. That a check finds another spectrum is no error, but a verdict. None of them harms the
 * question. */
PSPEC_EXPORT pspec_status pspec_question_answer(pspec_answer **out, pspec_question *question);

/** @}
 * @name Kernel interpolation on the sphere
 * @{ */

/** A function on the sphere through values [num_points] at unit vectors points [num_points][3]
 * (lengths may be off by 1e-6; they are divided): of all functions f of the Sobolev space H^s with
 * these values, 1 < s = smoothness < 2, the one of the smallest norm,
 *
 *     f^(u) = sum_i alpha_i K(u, u_i),   K alpha = f
 *     K(u, v) = c - |u - v|^(2s-2),            c = 2^(2s-1) / s
 *
 * The answer has the columns value, f^ at unit vectors at [num_at][3], O(num_points) each, and
 * where with_bounds is not 0 bound: |f(u) - f^(u)| <= bound |f| for every f of H^s with these
 * values, bound^2 = c - k(u) . K^-1 k(u), k_i(u) = K(u, u_i), O(num_points^2) each; and the entries
 * norm, that of f^ in H^s, sqrt(f . alpha), and condition, that of K in the 1-norm, estimated, or a
 * bound from below: above 4.5e11 fewer than four digits of alpha are right, since points lie
 * together.
 *
 * By Cholesky and a step of refinement in 8 num_points^2 bytes, or where these are more than the
 * memory limit of the context (without one: half of the machine's memory) by conjugate gradients on
 * the device; the progress callback is then told of their steps, the total being 0, and can cancel
 * them. Equal points are one: the first value counts. #PSPEC_ERROR_INPUT names points so near each
 * other that K is singular in double precision. */
PSPEC_EXPORT pspec_status pspec_interpolate(pspec_answer **out, pspec_context *context,
                                            size_t num_points, const double *points,
                                            const double *values, double smoothness, size_t num_at,
                                            const double *at, int with_bounds);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
