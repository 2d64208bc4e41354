/* How long a quadrature job takes beside its engine, phase by phase. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_PHASES_H
#define PS_JOBS_QUADRATURE_QUADRATURE_PHASES_H

#include "jobs/quadrature/quadrature_setup.h"
#include "plan/phases.h"

/* Returns by what the seconds of its engines are to be multiplied, as ps_power_job_phases. */
double ps_quadrature_phases(const ps_quadrature_setup *setup,
                            const ps_quadrature_question *question, ps_phases *phases);

/* Adds what the coefficients of a lobe take, made for so many degrees. */
void ps_phases_lobe(ps_phases *phases, const ps_representer *representer);

#endif
