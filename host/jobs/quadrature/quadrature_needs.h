/* What a quadrature job does not need, and what that is of the whole job's work. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_NEEDS_H
#define PS_JOBS_QUADRATURE_QUADRATURE_NEEDS_H

#include "jobs/quadrature/quadrature_setup.h"

/* From the question and setup->num_sets: realizations. Sets num_realizations, too. */
void ps_quadrature_needs_find(ps_quadrature_setup *setup, const ps_quadrature_question *question);
/* What the representer is to be made to: looser for many small rules, whose work its degrees would
 * be. */
double ps_quadrature_needs_accuracy(const ps_quadrature_setup *setup,
                                    const ps_quadrature_question *question, bool has_several);
/* Leaves out terms of kappa that cannot matter beside `accuracy`. */
void ps_quadrature_needs_terms(ps_quadrature_setup *setup, double accuracy);
/* Makes the plan, and lists what it skips, degrees and terms of kappa among it. held: bytes of the
 * machine's memory that the plan need not count as taken. */
pspec_status ps_quadrature_needs_plan(ps_quadrature_setup *setup,
                                      const ps_quadrature_question *question, uint64_t held,
                                      ps_error *error) PS_MUST_CHECK;
/* For who shows the shares: that of degrees becomes what planning for all of them says. */
pspec_status ps_quadrature_needs_rate(ps_quadrature_setup *setup,
                                      const ps_quadrature_question *question,
                                      ps_error *error) PS_MUST_CHECK;

#endif
