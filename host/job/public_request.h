/* What a plan of the public library is asked, checked: the same for the torus and the sphere. */
#ifndef PS_JOB_PUBLIC_REQUEST_H
#define PS_JOB_PUBLIC_REQUEST_H

#include "engines/frequencies.h"

typedef struct ps_public_request {
    ps_frequencies frequencies; /* owned; not necessarily enumerated */
    uint64_t num_points, num_realizations;
    pspec_normalization normalization;
    double tolerance, floor;
    const char *engine; /* borrowed from the caller's request; NULL: any */
    int precision;      /* a ps_precision, or -1: any */
    bool exact_shells, no_self_check;
} ps_public_request;

pspec_status ps_public_request_power(ps_public_request *out, const pspec_power_request *request,
                                     ps_error *error) PS_MUST_CHECK;
pspec_status ps_public_request_angular(ps_public_request *out, const pspec_angular_request *request,
                                       ps_error *error) PS_MUST_CHECK;

#endif
