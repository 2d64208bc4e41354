/* pointspec angular: the averaged angular power spectrum. */
#include "cli/command.h"

const ps_command ps_command_angular = {
    .name = "angular",
    .summary = "averaged angular power spectrum of point sets on the sphere",
    .usage = "angular [options] --sampler NAME | angular [options] FILE...",
    .description =
        "Averages P(l) = N Q(l) / (sum w)^2 over realizations, where Q(l) = sum_ij w_i w_j "
        "P_l(u_i.u_j) = 4 pi / (2l + 1) sum_m |sum_j w_j Y_lm(u_j)|^2, and prints it for the "
        "degrees 1..L with standard errors over the realizations; white noise has 1 everywhere. "
        "Files hold unit vectors or angles; several files, and several sets in a file, are "
        "realizations. With --hemisphere a point stands for its direction and the opposite one: "
        "even degrees only. The default --tol of 1e-6 bounds the numerical error of the "
        "coefficients relative to white noise.",
    .result = &ps_kind_angular,
    .takes = PS_VERB_BIT(angular),
    .examples = {"pointspec angular --sampler healpix-jittered:nside=8 -m 100 -l 64",
                 "pointspec sample --sampler fibonacci -n 256 | pointspec angular -l 32 -"},
};
