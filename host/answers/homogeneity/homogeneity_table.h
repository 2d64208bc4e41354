/* The table of check --homogeneous: a row for each ring or degree, whose phases are judged
 * together. */
#ifndef PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_TABLE_H
#define PS_ANSWERS_HOMOGENEITY_HOMOGENEITY_TABLE_H

#include "answers/spectra/question.h"
#include "spectra/phases/invariance.h"
#include "tables/table.h"

typedef struct ps_homogeneity_results {
    const ps_power_job *job;
    size_t num_tests;
    const ps_phase_label *labels; /* [num_tests] */
    const ps_phase_test *tests;   /* [num_tests] */
    size_t num_different;
} ps_homogeneity_results;

/* "(16,0) of amplitudes", "(16,0) of products up to 20 on axis 1", "degree 4, order 2 of amplitudes,
 * about x" */
pspec_status ps_phase_label_write(const ps_phase_label *label, const ps_frequencies *set,
                                  ps_text *out, ps_error *error) PS_MUST_CHECK;

pspec_status ps_homogeneity_table(ps_table **out, const ps_request *arguments,
                                  const ps_homogeneity_results *results,
                                  ps_error *error) PS_MUST_CHECK;

#endif
