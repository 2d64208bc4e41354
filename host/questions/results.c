/* The table of the kinds of results. */
#include "questions/results.h"

static const ps_option_id power[] = {PS_OPTION_SAMPLER,       PS_OPTION_POINTS,
                                     PS_OPTION_REALIZATIONS,  PS_OPTION_STANDARD_ERROR,
                                     PS_OPTION_DIMENSION,     PS_OPTION_SEED,
                                     PS_OPTION_HOMOGENIZE,    PS_OPTION_WEIGHTS,
                                     PS_OPTION_INPUT_FORMAT,  PS_OPTION_COLUMNS,
                                     PS_OPTION_SELECT_SETS,   PS_OPTION_WRAP,
                                     PS_OPTION_MAX_FREQUENCY, PS_OPTION_FREQUENCIES,
                                     PS_OPTION_SHELLS,        PS_OPTION_PER_RING,
                                     PS_OPTION_NORMALIZE,     PS_OPTION_TOLERANCE,
                                     PS_OPTION_FLOOR,         PS_OPTION_PRECISION,
                                     PS_OPTION_ENGINE,        PS_OPTION_NO_SKIP,
                                     PS_OPTION_NO_SELF_CHECK, PS_OPTION_MEMORY,
                                     PS_NUM_OPTIONS};

const ps_result_kind ps_result_power = {
    .name = "power", .options = power, .samples = PS_DOMAIN_TORUS};

static const ps_option_id angular[] = {PS_OPTION_SAMPLER,
                                       PS_OPTION_POINTS,
                                       PS_OPTION_REALIZATIONS,
                                       PS_OPTION_STANDARD_ERROR,
                                       PS_OPTION_SEED,
                                       PS_OPTION_HOMOGENIZE,
                                       PS_OPTION_WEIGHTS,
                                       PS_OPTION_INPUT_FORMAT,
                                       PS_OPTION_COLUMNS,
                                       PS_OPTION_SELECT_SETS,
                                       PS_OPTION_NORMALIZE_VECTORS,
                                       PS_OPTION_MAX_DEGREE,
                                       PS_OPTION_HEMISPHERE,
                                       PS_OPTION_NORMALIZE,
                                       PS_OPTION_TOLERANCE,
                                       PS_OPTION_FLOOR,
                                       PS_OPTION_PRECISION,
                                       PS_OPTION_ENGINE,
                                       PS_OPTION_NO_SKIP,
                                       PS_OPTION_NO_SELF_CHECK,
                                       PS_OPTION_MEMORY,
                                       PS_NUM_OPTIONS};

const ps_result_kind ps_result_angular = {
    .name = "angular", .options = angular, .samples = PS_DOMAIN_SPHERE};

static const ps_option_id pairs[] = {PS_OPTION_SAMPLER,
                                     PS_OPTION_POINTS,
                                     PS_OPTION_REALIZATIONS,
                                     PS_OPTION_STANDARD_ERROR,
                                     PS_OPTION_SEED,
                                     PS_OPTION_HOMOGENIZE,
                                     PS_OPTION_WEIGHTS,
                                     PS_OPTION_INPUT_FORMAT,
                                     PS_OPTION_COLUMNS,
                                     PS_OPTION_SELECT_SETS,
                                     PS_OPTION_NORMALIZE_VECTORS,
                                     PS_OPTION_MAX_DEGREE,
                                     PS_OPTION_HEMISPHERE,
                                     PS_OPTION_TOLERANCE,
                                     PS_OPTION_FLOOR,
                                     PS_OPTION_PRECISION,
                                     PS_OPTION_ENGINE,
                                     PS_OPTION_NO_SKIP,
                                     PS_OPTION_NO_SELF_CHECK,
                                     PS_OPTION_MEMORY,
                                     PS_NUM_OPTIONS};

const ps_result_kind ps_result_pairs = {
    .name = "pairs", .options = pairs, .samples = PS_DOMAIN_SPHERE};

static const ps_option_id quadrature[] = {PS_OPTION_SAMPLER,
                                          PS_OPTION_POINTS,
                                          PS_OPTION_REALIZATIONS,
                                          PS_OPTION_STANDARD_ERROR,
                                          PS_OPTION_SEED,
                                          PS_OPTION_HOMOGENIZE,
                                          PS_OPTION_BRDF,
                                          PS_OPTION_SMOOTHNESS,
                                          PS_OPTION_WEIGHTS,
                                          PS_OPTION_INPUT_FORMAT,
                                          PS_OPTION_COLUMNS,
                                          PS_OPTION_SELECT_SETS,
                                          PS_OPTION_NORMALIZE_VECTORS,
                                          PS_OPTION_MAX_DEGREE,
                                          PS_OPTION_TOLERANCE,
                                          PS_OPTION_PRECISION,
                                          PS_OPTION_ENGINE,
                                          PS_OPTION_NO_SKIP,
                                          PS_OPTION_DROP_BELOW,
                                          PS_OPTION_MEMORY,
                                          PS_NUM_OPTIONS};

const ps_result_kind ps_result_quadrature = {.name = "quadrature",
                                             .options = quadrature,
                                             .weights = "equal|column|optimal|FILE",
                                             .samples = PS_DOMAIN_SPHERE};

static const ps_option_id truncation[] = {PS_OPTION_BRDF, PS_OPTION_SMOOTHNESS,
                                          PS_OPTION_MAX_DEGREE, PS_OPTION_HARMONICS,
                                          PS_NUM_OPTIONS};

const ps_result_kind ps_result_truncation = {.name = "truncation", .options = truncation};

static const ps_option_id check[] = {PS_OPTION_AGAINST,
                                     PS_OPTION_FALSE_ALARM_RATE,
                                     PS_OPTION_SAMPLER,
                                     PS_OPTION_POINTS,
                                     PS_OPTION_REALIZATIONS,
                                     PS_OPTION_SEED,
                                     PS_OPTION_HOMOGENIZE,
                                     PS_OPTION_WEIGHTS,
                                     PS_OPTION_INPUT_FORMAT,
                                     PS_OPTION_COLUMNS,
                                     PS_OPTION_SELECT_SETS,
                                     PS_OPTION_WRAP,
                                     PS_OPTION_TOLERANCE,
                                     PS_OPTION_PRECISION,
                                     PS_OPTION_NORMALIZE_VECTORS,
                                     PS_OPTION_ENGINE,
                                     PS_OPTION_NO_SKIP,
                                     PS_OPTION_NO_SELF_CHECK,
                                     PS_OPTION_MEMORY,
                                     PS_NUM_OPTIONS};

const ps_result_kind ps_result_check = {
    .name = "check", .options = check, .samples = PS_DOMAIN_ANY};

const ps_result_kind *const ps_result_kinds[] = {&ps_result_power,
                                                 &ps_result_angular,
                                                 &ps_result_pairs,
                                                 &ps_result_quadrature,
                                                 &ps_result_truncation,
                                                 &ps_result_check,
                                                 NULL};
