/* --plot of power and angular. */
#ifndef PS_ANSWERS_SPECTRA_SPECTRUM_PLOT_H
#define PS_ANSWERS_SPECTRA_SPECTRUM_PLOT_H

#include "answers/spectra/question.h"

/* Curves of all jobs; the picture of the spectrum when there is one 2-D job on the torus. */
pspec_status ps_spectrum_plot(const ps_request *arguments, const ps_power_job *const *jobs,
                              size_t num, ps_error *error) PS_MUST_CHECK;

#endif
