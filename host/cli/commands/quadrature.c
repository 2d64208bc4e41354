/* pointspec quadrature: quadrature spectrum and worst-case error of rules for a BRDF. */
#include "cli/command.h"

const ps_command ps_command_quadrature = {
    .name = "quadrature",
    .summary = "quadrature spectrum and worst-case error of rules for a BRDF",
    .usage = "quadrature --brdf NAME [options] --sampler NAME | quadrature --brdf NAME [options] "
             "FILE...",
    .description =
        "For directions u_j with weights w_j (1/N unless given) as a rule for the integral of "
        "light times a BRDF, averages over realizations d_l^2 = (b_l - c_l0)^2, C_l^2 = 2 "
        "sum_{m>0} |c_lm|^2, c_lm = sum_j w_j Y_lm(u_j), and their share a_l (d_l^2 + C_l^2) of "
        "the squared worst-case error E^2 over the unit ball of the Sobolev space H^S. The header "
        "has E by the kernel form, the root of the mean of E^2, and the rest of E^2 beyond degree "
        "L. Points of samplers of the hemisphere are morphed to the BRDF unless morph= says "
        "otherwise.",
    .result = &ps_kind_quadrature,
    .takes = PS_VERB_BIT(quadrature),
    .examples = {"pointspec quadrature --sampler fibonacci-hemisphere -n 256 --brdf diffuse "
                 "--smoothness 1.5 --weights optimal",
                 "pointspec quadrature --sampler white-hemisphere -n 64 -m 50 --brdf glossy:n=30 "
                 "-l 40"},
};
