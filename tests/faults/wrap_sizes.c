/* Small input in the ways of large input, so that these have faults as well: what the product takes
 * from the device or has as a constant comes from the environment here.
 *
 *     POINTSPEC_FAULT_WHOLE_BYTES        larger sets of files come in blocks (PS_SOURCE_WHOLE_BYTES)
 *     POINTSPEC_FAULT_PLANNED_POINTS     torus_nufft chooses for so many points: millions go on a grid
 *     POINTSPEC_FAULT_ALLOCATION_BYTES   the largest buffer that the device says it allows: larger grids are split
 *                                        (wrap_opencl.c)
 */
#include "faults.h"

#include "engines/torus/nufft/choice.h"
#include "jobs/source.h"

#include <stdlib.h>

uint64_t fault_size(const char *variable) {
    const char *const text = getenv(variable);
    return text != NULL ? strtoull(text, NULL, 10) : 0;
}

WRAPPER(ps_source_files, pspec_status,
        (ps_source * *out, const char *const *paths, size_t num_paths,
         const ps_source_options *options, ps_error *error)) {
    ps_source_options own = *options;
    const uint64_t bytes = fault_size("POINTSPEC_FAULT_WHOLE_BYTES");
    own.whole_bytes = bytes > 0 ? bytes : own.whole_bytes;
    return __real_ps_source_files(out, paths, num_paths, &own, error);
}

WRAPPER(ps_nufft_choose, ps_nufft_choice,
        (const ps_problem *problem, const ps_device_limits *limits, ps_precision precision)) {
    ps_problem own = *problem;
    const uint64_t num_points = fault_size("POINTSPEC_FAULT_PLANNED_POINTS");
    own.planned_points = num_points > 0 ? num_points : own.planned_points;
    return __real_ps_nufft_choose(&own, limits, precision);
}
