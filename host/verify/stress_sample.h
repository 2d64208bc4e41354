/* The points of a case with what the referee makes of them. */
#ifndef PS_VERIFY_STRESS_SAMPLE_H
#define PS_VERIFY_STRESS_SAMPLE_H

#include "jobs/pattern_check.h"
#include "verify/stress.h"

typedef struct ps_stress_sample {
    const ps_stress_case *what;
    pspec_pattern pattern;
    ps_pattern_sums sums; /* of weights w 2^-exponent, as all that follows */
    ps_frequencies frequencies;
    size_t num_checked;
    uint32_t *checked;  /* indices of the frequencies that the referee has looked at */
    long double *truth; /* [num_checked]: |S|, or Q(l) */
    long double (
        *harmonics)[2]; /* c_lm, m >= 0, of the degrees checked, one after the other, or NULL */
    double mean_power;  /* of all of them over V; 0 unless all are checked */
} ps_stress_sample;

/* Points and frequencies, without the truth. */
pspec_status ps_stress_sample_create(ps_stress_sample *out, const ps_stress_case *what,
                                     ps_error *error) PS_MUST_CHECK;
/* Asks the referee, unless it was asked before. */
pspec_status ps_stress_sample_judge(ps_stress_sample *sample, bool (*should_stop)(void *payload),
                                    void *payload, ps_error *error) PS_MUST_CHECK;
void ps_stress_sample_free(ps_stress_sample *sample);

/* The weight that the power of a frequency or degree has in means: 1, or 2l + 1. */
double ps_stress_modes(const ps_stress_sample *sample, size_t frequency);

/* The points of a realization of the case; those of the sample are of realization 0. */
pspec_status ps_stress_points_make(const ps_stress_case *what, uint64_t realization,
                                   pspec_pattern *out, ps_error *error) PS_MUST_CHECK;

/* What `pointspec stress` asks an engine for; frequencies belong to the sample. */
ps_problem ps_stress_problem(const ps_stress_sample *sample, ps_precision precision);

/* The error of an engine that is asked for the problem, and its formula with the power that was
 * measured. */
pspec_status ps_stress_measure(const ps_stress_sample *sample, const ps_problem *problem,
                               const ps_engine *engine, ps_precision precision, ps_device *device,
                               double *found, double *bound, ps_error *error) PS_MUST_CHECK;

#endif
