/* pointspec truncation: the error of shading integrals as truncated products in harmonics, and how
 * many points of a rule have the same. */
#include "cli/command.h"

const ps_command ps_command_truncation = {
    .name = "truncation",
    .summary = "error of shading integrals by truncated harmonics, and equivalent points",
    .usage = "truncation --brdf NAME[:key=value,...] [options]",
    .description =
        "Prints for L = 0, 1, ... the worst-case error of the integral of light times BRDF when "
        "it is a sum over harmonics up to and including degree L, for light from the unit ball of "
        "the Sobolev space H^S: E(L)^2 = sum_{l>L} a_l b_l^2 for spherical harmonics. "
        "equivalent_points is the number of spherical Fibonacci points, morphed to the lobe and "
        "with equal weights, whose worst-case error is the same.",
    .result = &ps_kind_truncation,
    .takes = PS_VERB_BIT(truncation),
    .examples =
        {"pointspec truncation --brdf glossy:n=30 --smoothness 1.5 -l 12",
         "pointspec truncation --brdf diffuse --harmonics hemispherical -l 4 --format json"},
};
