/* Some of the realizations of a job: a part to be put together with others. */
#ifndef PS_PLAN_RANGE_H
#define PS_PLAN_RANGE_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* Counted from 0. */
typedef struct ps_realization_range {
    uint64_t first, end; /* one past the last; 0: all of them */
} ps_realization_range;

/* ---- what is wrong with one ------------------------------------------------------------------ */

/* PSPEC_ERROR_INVALID_ARGUMENT: "--range A:B WHY" */
pspec_status ps_range_refuse(const ps_realization_range *range, const char *why, ps_error *error);
/* That there is one realization, which may stand for all. */
pspec_status ps_range_refuse_one(const ps_realization_range *range, bool stands_for_all,
                                 ps_error *error);
/* Does it end beyond all realizations, those of a sampler or of files? */
pspec_status ps_range_check_end(const ps_realization_range *range, uint64_t num, bool are_sampled,
                                ps_error *error) PS_MUST_CHECK;
/* Does the next begin where this one ends? Else PSPEC_ERROR_INPUT; names are those of both in
 * sentences. */
pspec_status ps_range_check_next(const ps_realization_range *range,
                                 const ps_realization_range *next, const char *const names[2],
                                 ps_error *error) PS_MUST_CHECK;
/* PSPEC_ERROR_TOLERANCE of ranges that are put together, whose plan is not exact enough for the
 * powers of all: the numerical error that there is, and may be. */
pspec_status ps_range_refuse_powers(double numerical, double tolerance, ps_error *error);

#endif
