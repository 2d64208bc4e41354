/* Answers to ranges of the realizations of one job, on their way to the answer of the job. */
#ifndef PS_ANSWERS_RANGES_RANGES_H
#define PS_ANSWERS_RANGES_RANGES_H

#include "answers/kind.h"
#include "base/memory.h"

/* The same parts, in the order of their realizations where all are ranges (in that of the command
 * line else), with memory of the pool. Ranges of different jobs are PSPEC_ERROR_INPUT. */
pspec_status ps_ranges_sort(ps_parts *out, ps_pool *memory, const ps_parts *parts,
                            ps_error *error) PS_MUST_CHECK;

/* The entries `merged` of an answer that is merged of these: their command lines, or those of what
 * they were merged of. */
pspec_status ps_ranges_tell(ps_table *table, const ps_parts *parts, ps_error *error) PS_MUST_CHECK;
/* The command line of a part; of an answer that was merged that of its first part. */
const char *ps_ranges_command(const ps_table *table);
/* Are both of one job, by their headers? Else PSPEC_ERROR_INPUT, which calls b `name`. request: of
 * the job, where it is known. */
pspec_status ps_ranges_compare(const ps_table *a, const ps_table *b, const char *name,
                               const ps_request *request, ps_error *error) PS_MUST_CHECK;

/* The header entry number `index` of that key, or a missing one; how many there are. */
ps_cell ps_entry_find(const ps_table *table, const char *key, size_t index);
size_t ps_entry_count(const ps_table *table, const char *key);
bool ps_cells_are_same(const ps_cell *a, const ps_cell *b);

#endif
