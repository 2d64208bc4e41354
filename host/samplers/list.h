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
extern const ps_sampler ps_sampler_pmj02;
extern const ps_sampler ps_sampler_cmj;
extern const ps_sampler ps_sampler_fibonacci_lattice;
extern const ps_sampler ps_sampler_rank1;
extern const ps_sampler ps_sampler_kronecker;
extern const ps_sampler ps_sampler_poisson_disk;
extern const ps_sampler ps_sampler_bridson;
extern const ps_sampler ps_sampler_bnot;
extern const ps_sampler ps_sampler_fpo;
extern const ps_sampler ps_sampler_ccvt;
extern const ps_sampler ps_sampler_gaussian_blue_noise;
extern const ps_sampler ps_sampler_step;
extern const ps_sampler ps_sampler_white_sphere;
extern const ps_sampler ps_sampler_zphi;
extern const ps_sampler ps_sampler_healpix;
extern const ps_sampler ps_sampler_healpix_jittered;
extern const ps_sampler ps_sampler_fibonacci;
extern const ps_sampler ps_sampler_spiral;
extern const ps_sampler ps_sampler_poisson_disk_sphere;
extern const ps_sampler ps_sampler_ccvt_sphere;
extern const ps_sampler ps_sampler_white_hemisphere;
extern const ps_sampler ps_sampler_fibonacci_hemisphere;

#endif
