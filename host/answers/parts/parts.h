/* A job as parts: ranges of its realizations that are answered apart, by processes or by threads of
 * one, and merged to the answer that one process would have given, to the bit.
 *
 * How many parts a job has is settled when it begins: those of a job that goes on from checkpoints
 * are those of its first start, whoever answers them now. Several parts may be answered at a time
 * by threads of a process, each with hooks of its own.
 */
#ifndef PS_ANSWERS_PARTS_PARTS_H
#define PS_ANSWERS_PARTS_PARTS_H

#include "answers/kind.h"

/* ---- which parts there are (parts.c) --------------------------------------------------------- */

/* Some of several things in a row. */
typedef struct ps_dealt {
    uint64_t first, num;
} ps_dealt;

/* Things are dealt to takers as evenly as they can be, in order; .num of one that gets none is 0.
 */
ps_dealt ps_parts_deal(uint64_t num_things, uint64_t num_takers, uint64_t taker);
/* Blocks that parts are whole numbers of, and so the most parts. */
uint64_t ps_parts_most(uint64_t num_realizations);
/* That of part `part`, from 0, of num_parts, at most ps_parts_most. */
ps_realization_range ps_parts_range(uint64_t num_realizations, uint64_t num_parts, uint64_t part);

/* How many parts the job has that left checkpoints, or locks of them, for this --checkpoint; 1: it
 * was no job of parts; 0: there are none. Those of several jobs are PSPEC_ERROR_INPUT. */
pspec_status ps_parts_find(uint64_t *num_parts, const char *path, ps_error *error) PS_MUST_CHECK;

/* ---- one of them (part.c) -------------------------------------------------------------------- */

/* Stays where it is: its request borrows from it, and from that of the job. */
typedef struct ps_part {
    ps_request request; /* of its range, for a table with state */
    char range[48];
    ps_text checkpoint, key;
} ps_part;

/* Part number `part`, from 0, of num_parts that num_realizations are cut into: those of the job, or
 * of the range that the request names. *out is ended by ps_part_end, also after an error.
 * hooks hear of checkpoints until then. Its request is answered as any other. */
pspec_status ps_part_begin(ps_part *out, const ps_kind *kind, const ps_request *request,
                           uint64_t num_realizations, uint64_t num_parts, uint64_t part,
                           const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
/* {0} is allowed. The checkpoint of a part that is answered stays until the answer of the job is
 * written: is_written. */
void ps_part_end(ps_part *part, bool is_written);

/* Tables of all parts. Their powers decide together whether they are planned once more, as those of
 * one process do: *is_again: all parts are to be begun and answered anew, with what they follow
 * then, replans[num_questions], in the request that they are made of. That is so, too, where some
 * have gone on from checkpoints of a later plan than others. PSPEC_ERROR_TOLERANCE: there have been
 * enough plans. */
pspec_status ps_parts_plan_again(bool *is_again, ps_replan *replans, size_t num_questions,
                                 const ps_table *const *tables, const char *const *names,
                                 size_t num, ps_error *error) PS_MUST_CHECK;

/* Merges tables[num] of all parts, in any order, to the answer of the job, or of the range that the
 * request names. names: of the parts, in sentences. *out is freed by ps_answer_free, also after an
 * error. */
pspec_status ps_parts_merge(ps_answer *out, const ps_request *request,
                            const ps_table *const *tables, const char *const *names, size_t num,
                            ps_error *error) PS_MUST_CHECK;
/* The same, and writes the files that the request names. */
pspec_status ps_parts_finish(ps_answer *out, const ps_kind *kind, const ps_request *request,
                             const ps_table *const *tables, const char *const *names, size_t num,
                             const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
