/* pointspec pairs: Legendre sums over all pairs of points. */
#include "cli/command.h"

const ps_command ps_command_pairs = {
    .name = "pairs",
    .summary = "Legendre sums over all pairs of points on the sphere",
    .usage = "pairs [options] --sampler NAME | pairs [options] FILE...",
    .description =
        "Averages Q(l) = sum_ij w_i w_j P_l(u_i.u_j) over realizations, and "
        "C_l^2 = 2 sum_{m > 0} |c_lm|^2 = (2l + 1) / (4 pi) Q(l) - c_l0^2, the part of it that "
        "depends on the azimuth, and prints both for the degrees 1..L with standard errors over "
        "the realizations. Weights are 1/N unless given. Files hold unit vectors or angles; "
        "several files, and several sets in a file, are realizations. With --hemisphere a point "
        "stands for its direction and the opposite one: even degrees only. --tol (default 1e-6) is "
        "the "
        "largest error of Q(l) in units of (sum |w|)^2; --floor P asks for sums down to P sum w^2 "
        "right to 10 %, which sums over pairs lose sooner than sums of squares do.",
    .result = &ps_kind_pairs,
    .takes = PS_VERB_BIT(pairs),
    .examples = {"pointspec pairs --sampler fibonacci -n 256 -l 32",
                 "pointspec pairs --sampler white-hemisphere -n 64 -m 100 -l 16 --tol 1e-10"},
};
