#include "samplers/forces/need_doubles.h"

pspec_status ps_forces_need_doubles(const ps_device_limits *limits, const char *sampler,
                                    ps_error *error) {
    return limits->has_fp64
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_DEVICE,
                     "sampler %s computes in double precision, which the device \"%s\" does not "
                     "have; --device cpu names one that does",
                     sampler, limits->name);
}
