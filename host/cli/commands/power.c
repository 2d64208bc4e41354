/* pointspec power: the averaged periodogram. */
#include "cli/command.h"

const ps_command ps_command_power = {
    .name = "power",
    .summary = "averaged periodogram of point sets on the torus",
    .usage = "power [options] --sampler NAME | power [options] FILE...",
    .description =
        "Averages the periodogram P(k) = N |sum w exp(-2 pi i k.x)|^2 / (sum w)^2 over "
        "realizations "
        "and prints its mean over rings of width 1, with standard errors over the realizations. "
        "In a box that is no cube (--box, or of the file) |k| is in cycles per edge of the cube "
        "of the same volume. "
        "Files hold points of [0,1)^d; several files, and several sets in a file, are "
        "realizations. "
        "The default --tol of 1e-6 bounds the numerical error of S relative to white noise.",
    .result = &ps_kind_power,
    .takes = PS_VERB_BIT(power),
    .examples = {"pointspec power --sampler jittered -n 1024 -m 100 -k 64",
                 "pointspec sample --sampler halton -n 256 | pointspec power -k 32 -"},
};
