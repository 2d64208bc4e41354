/* Every sampler of the table, for table.c and for the file that defines it. */
#ifndef PS_SAMPLERS_LIST_H
#define PS_SAMPLERS_LIST_H

#include "samplers/sampler.h"

extern const ps_sampler ps_sampler_white;
extern const ps_sampler ps_sampler_regular;
extern const ps_sampler ps_sampler_jittered;
extern const ps_sampler ps_sampler_latin_hypercube;
extern const ps_sampler ps_sampler_sobol;
extern const ps_sampler ps_sampler_halton;
extern const ps_sampler ps_sampler_hammersley;
extern const ps_sampler ps_sampler_larcher_pillichshammer;

#endif
