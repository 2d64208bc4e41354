#include "plan/range.h"

#include <inttypes.h>
#include <stdio.h>

pspec_status ps_range_refuse(const ps_realization_range *range, const char *why, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "--range %" PRIu64 ":%" PRIu64 " %s",
                   range->first, range->end, why);
}

pspec_status ps_range_refuse_one(const ps_realization_range *range, bool stands_for_all,
                                 ps_error *error) {
    return ps_range_refuse(range,
                           stands_for_all
                               ? "has no use: all realizations of the sampler have the same "
                                 "powers, and one stands for all (--no-skip computes them)"
                               : "has no use: there is one realization",
                           error);
}

pspec_status ps_range_check_end(const ps_realization_range *range, uint64_t num, bool are_sampled,
                                ps_error *error) {
    enum { BYTES = 128 };
    char why[BYTES];
    if (range->end <= num) {
        return PSPEC_OK;
    }
    snprintf(why, sizeof why, "goes beyond the realizations, of which there %s %" PRIu64 "%s",
             num == 1 ? "is" : "are", num, are_sampled ? " (--realizations)" : "");
    return ps_range_refuse(range, why, error);
}

pspec_status ps_range_check_next(const ps_realization_range *range,
                                 const ps_realization_range *next, const char *const names[2],
                                 ps_error *error) {
    if (next->first < range->end) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s has the realizations %" PRIu64 ":%" PRIu64 ", but those up to %" PRIu64
                       " are of %s already: they overlap",
                       names[1], next->first, next->end, range->end, names[0]);
    }
    return next->first == range->end ? PSPEC_OK
                                     : ps_fail(error, PSPEC_ERROR_INPUT,
                                               "the realizations %" PRIu64 ":%" PRIu64
                                               " are missing, between those of %s and of %s",
                                               range->end, next->first, names[0], names[1]);
}

pspec_status ps_range_refuse_powers(double numerical, double tolerance, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                   "the powers of these realizations need a more exact plan: the error is %.2g, "
                   "above the tolerance %g; run the ranges again with a smaller --tol, or with "
                   "--precision double",
                   numerical, tolerance);
}
