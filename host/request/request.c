#include "request/request.h"

#include "request/options.h"

const ps_request ps_request_default = {.num_counts = 1,
                                       .counts = {1024},
                                       .num_realizations = 1,
                                       .num_shifts = 1,
                                       .dimension = 2,
                                       .seed = 1,
                                       .cache_bytes = 1000000000,
                                       .reading = {.domain = PS_DOMAIN_ANY},
                                       .accuracy = {.tolerance = 1e-6},
                                       .limits = {.constraints = {.precision = -1},
                                                  .kept_bytes = 4000000000,
                                                  .checkpoint = {.interval = UINT64_MAX}},
                                       .false_alarm_rate = 1e-3,
                                       .num_smoothness = 1,
                                       .smoothness = {1.5},
                                       .image = {256, 256},
                                       .num_reference = 4096,
                                       .command_line = ""};

pspec_status ps_request_check_one_count(const ps_request *request, const char *why,
                                        ps_error *error) {
    return request->num_counts == 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s names %zu numbers of points, %s",
                         ps_option_show(request, PS_OPTION_POINTS).text, request->num_counts, why);
}

pspec_status ps_request_check_no_files(const ps_request *request, const char *instead,
                                       ps_error *error) {
    return request->num_files == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no file is read, but %s was given%s",
                         request->files[0], instead);
}

bool ps_request_only_draws(const ps_request *request) {
    return request->plot != NULL && !request->is_given[PS_OPTION_OUTPUT] &&
           !request->is_given[PS_OPTION_FORMAT];
}
