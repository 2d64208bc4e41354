/* How long a quadrature job takes beside its engine, phase by phase. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_PHASES_H
#define PS_JOBS_QUADRATURE_QUADRATURE_PHASES_H

#include "jobs/quadrature/quadrature_job.h"
#include "plan/phases.h"

/* Returns by what the seconds of its engines are to be multiplied, as ps_power_job_phases. */
double ps_quadrature_job_phases(const ps_quadrature_job *job, ps_phases *phases);

/* Adds what the coefficients of a lobe take, made for so many degrees. */
void ps_phases_lobe(ps_phases *phases, const ps_representer *representer);

/* Adds kappa of sets of so many points and of so many terms, or so many distances of each set in
 * powers of 2 s - 2, to the phase of that name (ps_cost_rule_seconds). */
void ps_phases_kappa(ps_phases *phases, const char *name, double points, double terms, double sets);
void ps_phases_distances(ps_phases *phases, const char *name, double smoothness, double distances,
                         double sets);

#endif
