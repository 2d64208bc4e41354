/* What a plan of the public library is asked, checked: the same for the torus and the sphere. */
#ifndef PS_API_PUBLIC_REQUEST_H
#define PS_API_PUBLIC_REQUEST_H

#include "frequencies/frequencies.h"

typedef struct ps_public_request {
    ps_frequencies frequencies; /* owned; not necessarily enumerated */
    uint64_t num_points, num_realizations;
    pspec_normalization normalization;
    double tolerance, floor;
    const char *engine; /* borrowed from the caller's request; NULL: any */
    int precision;      /* a ps_precision, or -1: any */
    bool is_on_sphere, no_self_check, want_c2;
} ps_public_request;

/* name: NULL for any, which is -1. */
pspec_status ps_public_parse_precision(const char *name, int *out, ps_error *error) PS_MUST_CHECK;
/* begin_with: the macro of the caller's struct. */
pspec_status ps_public_check_size(size_t found, size_t expected, const char *begin_with,
                                  ps_error *error) PS_MUST_CHECK;

pspec_status ps_public_request_power(ps_public_request *out, const pspec_power_request *request,
                                     ps_error *error) PS_MUST_CHECK;
pspec_status ps_public_request_angular(ps_public_request *out, const pspec_angular_request *request,
                                       ps_error *error) PS_MUST_CHECK;

#endif
