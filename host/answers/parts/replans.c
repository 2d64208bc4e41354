/* Another plan of all parts of a job. */
#include "answers/parts/parts.h"

#include "spectra/spectrum_state.h"

/* Of all parts of a question: errors together, and the latest plan; *differ: others have one before
 * it. */
static pspec_status join(ps_spectrum_sums *out, bool *differ, size_t question,
                         const ps_table *const *tables, const char *const *names, size_t num,
                         ps_error *error) {
    PS_TRY(ps_spectrum_state_read_errors(out, tables[0], question, names[0], error));
    *differ = false;
    for (size_t p = 1; p < num; p++) {
        ps_spectrum_sums part;
        PS_TRY(ps_spectrum_state_read_errors(&part, tables[p], question, names[p], error));
        *differ = *differ || part.planned.num != out->planned.num;
        out->planned = part.planned.num > out->planned.num ? part.planned : out->planned;
        ps_spectrum_sums_join_errors(out, &part);
    }
    return PSPEC_OK;
}

static pspec_status plan_again(bool *is_again, ps_replan *replan, const ps_spectrum_sums *joined,
                               bool differ, ps_error *error) {
    *replan = joined->planned;
    *is_again = *is_again || differ || !(joined->error <= joined->tolerance);
    if (differ || joined->error <= joined->tolerance) {
        return PSPEC_OK;
    }
    if (joined->planned.num >= PS_MOST_REPLANS) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "no plan meets the tolerance %g with the powers that were measured",
                       joined->tolerance);
    }
    *replan = (ps_replan){joined->planned.num + 1, joined->largest_power, joined->largest_share,
                          joined->totals.largest_points};
    return PSPEC_OK;
}

pspec_status ps_parts_plan_again(bool *is_again, ps_replan *replans, size_t num_questions,
                                 const ps_table *const *tables, const char *const *names,
                                 size_t num, ps_error *error) {
    *is_again = false;
    for (size_t i = 0; i < num_questions; i++) {
        ps_spectrum_sums joined;
        bool differ = false;
        PS_TRY(join(&joined, &differ, i, tables, names, num, error));
        PS_TRY(plan_again(is_again, &replans[i], &joined, differ, error));
    }
    return PSPEC_OK;
}
