/* Sums of a spectrum as state of a table (fields/table.h): arrays from which every number of an
 * answer follows, and which answers are merged by.
 *
 * Of the first question of an answer they have these names, of the second "state_bins_2", and so
 * on. Sums are rows of (high, low) of the sum and (high, low) of the sum of squares.
 *
 *     state_question     what the frequencies are; spectrum_state_places.h
 *     state_totals       realizations, points, weights, errors; the same
 *     state_bins         [bins][4], the unreported bin included
 *     state_powers       [frequencies][4], or [2] where nobody asked for their errors; not on the
 *                        sphere, where bins are degrees
 *     state_c2           [degrees][4], of pair sums
 *     state_frequencies  [frequencies][components], of a list, or of a subset of rings
 *     state_rings        [bins][2] of such a subset: how many frequencies they have, mean |k|
 *
 * Of a range of the realizations of a job also what ranges are put together from (sum_nodes.h):
 *
 *     state_range        the range, the realizations of the job, precision and tolerance, and what
 *                        the plan was made for, and another would be
 *     state_parts        [parts][14], the realizations of every node, and the sums of its totals
 *     state_part_bins    [parts][bins][4], and likewise
 *     state_part_powers
 *     state_part_c2
 */
#ifndef PS_SPECTRA_SPECTRUM_STATE_H
#define PS_SPECTRA_SPECTRUM_STATE_H

#include "spectra/spectrum_sums.h"
#include "fields/table.h"

/* Adds the state of question number `question`, from 0, to a table that has none of it. */
pspec_status ps_spectrum_state_add(ps_table *table, size_t question, const ps_spectrum_sums *sums,
                                   ps_error *error) PS_MUST_CHECK;

/* The same of a range (spectrum_state_range.c); part of the other. */
pspec_status ps_spectrum_state_add_range(ps_table *table, size_t question,
                                         const ps_spectrum_sums *sums,
                                         ps_error *error) PS_MUST_CHECK;
/* Part of ps_spectrum_state_read: nodes and tolerance of sums that have all else, where the table
 * is of a range. */
pspec_status ps_spectrum_state_read_range(ps_spectrum_sums *sums, const ps_table *table,
                                          size_t question, const char *name,
                                          ps_error *error) PS_MUST_CHECK;

pspec_status ps_spectrum_state_read_errors_of_range(ps_spectrum_sums *sums, const ps_table *table,
                                                    size_t question, const char *name,
                                                    ps_error *error) PS_MUST_CHECK;

/* Has the table state of that question? */
bool ps_spectrum_state_is_there(const ps_table *table, size_t question);

/* The sums, and the bins of their frequencies, both freed by the caller. name is that of the table
 * in sentences. State that is missing, or that no spectrum has, is PSPEC_ERROR_INPUT; memory is in
 * proportion to that of the table. */
pspec_status ps_spectrum_state_read(ps_spectrum_sums *out, ps_bins *bins, const ps_table *table,
                                    size_t question, const char *name,
                                    ps_error *error) PS_MUST_CHECK;
/* The same without any sums: totals, errors, and what plans are made for. There is nothing to be
 * freed. */
pspec_status ps_spectrum_state_read_errors(ps_spectrum_sums *out, const ps_table *table,
                                           size_t question, const char *name,
                                           ps_error *error) PS_MUST_CHECK;

#endif
