#include "samplers/list.h"

/* In the order of the help text: torus, sphere, hemisphere. A new sampler is a file, a line in
 * list.h and a row here. */
const ps_sampler *const ps_samplers[] = {
    &ps_sampler_white,
    &ps_sampler_regular,
    &ps_sampler_jittered,
    &ps_sampler_latin_hypercube,
    &ps_sampler_sobol,
    &ps_sampler_halton,
    &ps_sampler_hammersley,
    &ps_sampler_larcher_pillichshammer,
    &ps_sampler_poisson_disk,
    &ps_sampler_bridson,
    &ps_sampler_bnot,
    &ps_sampler_fpo,
    &ps_sampler_ccvt,
    &ps_sampler_gaussian_blue_noise,
    &ps_sampler_step,
    &ps_sampler_white_sphere,
    &ps_sampler_zphi,
    &ps_sampler_healpix,
    &ps_sampler_healpix_jittered,
    &ps_sampler_fibonacci,
    &ps_sampler_spiral,
    &ps_sampler_poisson_disk_sphere,
    &ps_sampler_ccvt_sphere,
    &ps_sampler_white_hemisphere,
    &ps_sampler_fibonacci_hemisphere,
    NULL,
};
