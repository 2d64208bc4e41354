#include "results/kind.h"

const ps_result_kind *const ps_result_kinds[] = {&ps_result_power,
                                                 &ps_result_angular,
                                                 &ps_result_pairs,
                                                 &ps_result_quadrature,
                                                 &ps_result_truncation,
                                                 &ps_result_check,
                                                 NULL};
