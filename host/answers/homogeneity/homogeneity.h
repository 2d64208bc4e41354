/* check --homogeneous: have realizations the law of their own translates, or rotations? */
#ifndef PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_H
#define PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_H

#include "answers/kind.h"
#include "answers/spectra/question.h"
#include "spectra/phases/invariance.h"

typedef struct ps_homogeneity {
    ps_request own;
    ps_question_list list;
    size_t num_parts;
    ps_power_job *job;         /* of the part that came last */
    size_t num_tests;          /* as many as phases, of all parts */
    ps_phase_label *labels;    /* [num_tests], part by part */
    ps_phase_test *tests;      /* [num_tests] */
    size_t num_different;      /* of them */
    ps_invariance *invariance; /* of the part that is done */
} ps_homogeneity;

/* As the calls of ps_kind do. */
pspec_status ps_homogeneity_check(const ps_request *request, ps_error *error) PS_MUST_CHECK;
pspec_status ps_homogeneity_plan(ps_planner *planner, const ps_request *request,
                                 ps_error *error) PS_MUST_CHECK;
pspec_status ps_homogeneity_compute(ps_homogeneity **out, const ps_request *request,
                                    const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
pspec_status ps_homogeneity_tabulate(ps_answer *out, const ps_homogeneity *computed,
                                     ps_error *error) PS_MUST_CHECK;
void ps_homogeneity_discard(ps_homogeneity *computed);

/* "(16,0) of amplitudes", "(16,0) of products up to 20 on axis 1", "degree 4, order 2 of amplitudes,
 * about x" */
pspec_status ps_phase_label_write(const ps_phase_label *label, const ps_frequencies *set,
                                  ps_text *out, ps_error *error) PS_MUST_CHECK;
/* A row for each ring or degree, whose phases are judged together. */
pspec_status ps_homogeneity_table(ps_table **out, const ps_homogeneity *computed,
                                  ps_error *error) PS_MUST_CHECK;

/* Of any check: how many of how many things differ, "3 of 12 rings", and the smallest adjusted
 * probability. */
pspec_status ps_verdict_add(ps_table *table, double false_alarm_rate, const char *different,
                            double smallest_p_value, bool is_different,
                            ps_error *error) PS_MUST_CHECK;
/* After the table, which is there whatever the verdict: PSPEC_ERROR_CHECK is no error of the work.
 */
pspec_status ps_verdict_take(ps_answer *out, pspec_status judged, ps_error *error) PS_MUST_CHECK;

#endif
