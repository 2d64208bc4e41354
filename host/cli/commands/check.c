/* pointspec check: is this sampler's spectrum the saved one, or are realizations homogeneous? */
#include "cli/command.h"

const ps_command ps_command_check = {
    .name = "check",
    .summary = "is this the spectrum that was saved, statistically?",
    .usage = "check --against FILE|--homogeneous [options] FILE... | check --against "
             "FILE|--homogeneous --sampler NAME",
    .description =
        "Measures the spectrum that the saved one is of (domain, dimension, K or L, rings or "
        "shells, "
        "normalization and number of points are taken from it) and compares the powers of all "
        "rings "
        "or degrees, with the standard errors of both sides. Exit status 0: nothing differs; 3: "
        "some do, the table and the message say which. For samplers that have not changed that "
        "happens with the probability of --false-alarm-rate at most, for all rings together. The "
        "saved spectrum is a table of power or angular as JSON, or a file of pspec_spectrum_save. "
        "Another one in the place of the point files is compared with it, nothing being computed. "
        "A sampler gets as many points and realizations as were saved and the seed after the saved "
        "one, unless others are given. With --homogeneous the question is whether realizations "
        "have the law of their own translates (on the sphere: rotations), as prediction of "
        "variance from spectra wants it: the phases of S(k), or of c_lm, and of sums of their "
        "products must then be uniform.",
    .result = &ps_kind_check,
    .takes = PS_VERB_BIT(check),
    .examples = {"pointspec power --sampler jittered -n 256 -m 64 -o saved.json && pointspec check "
                 "--against saved.json --sampler jittered -m 16",
                 "pointspec check --homogeneous --sampler jittered -n 256 --homogenize"},
};
