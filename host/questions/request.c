#include "questions/request.h"

const ps_request ps_request_default = {.num_points = 1024,
                                       .num_realizations = 1,
                                       .dimension = 2,
                                       .seed = 1,
                                       .cache_bytes = 1000000000,
                                       .reading = {.domain = PS_DOMAIN_ANY},
                                       .accuracy = {.tolerance = 1e-6},
                                       .limits = {.constraints = {.precision = -1}},
                                       .false_alarm_rate = 1e-3,
                                       .smoothness = 1.5,
                                       .command_line = ""};

bool ps_request_only_draws(const ps_request *request) {
    return request->plot != NULL && !request->is_given[PS_OPTION_OUTPUT] &&
           !request->is_given[PS_OPTION_FORMAT];
}
