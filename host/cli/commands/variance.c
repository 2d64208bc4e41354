/* pointspec variance: the variance of Monte Carlo integration, predicted and measured. */
#include "cli/command.h"

const ps_command ps_command_variance = {
    .name = "variance",
    .summary = "variance of Monte Carlo integration, predicted from spectra and measured",
    .usage = "variance --integrand NAME [options] --sampler NAME | variance --integrand NAME "
             "[options] FILE...",
    .description =
        "The variance of the mean of an integrand over N points of a sampler, predicted from the "
        "spectra of M realizations as (1/N) sum P(k) |f_k|^2 over all k but 0 (on the sphere (4 "
        "pi/N) sum (2l+1) P(l) P_F(l)), and measured beside it by M other realizations, each "
        "shifted or rotated at random --shifts times. Of files the first half of the sets "
        "predicts, "
        "and the second is measured; a single set is both, and has the sum over its pairs in the "
        "header. What lies beyond the cut-off is taken for "
        "white; lower and upper have nothing there, and the most power that there can be. z_score "
        "is measured minus predicted over both standard errors; white is the variance of as many "
        "independent points.",
    .result = &ps_kind_variance,
    .takes = PS_VERB_BIT(variance),
    .examples = {"pointspec variance --sampler jittered --integrand disk:radius=0.25 -n 16..1024 "
                 "-m 100",
                 "pointspec variance --sampler healpix-jittered --integrand cap -n 48,192,768 -m "
                 "50"},
};
