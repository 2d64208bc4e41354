/* What samplers of forces have in common: the device that makes a set, lent by who makes many (the
 * request's lender), else opened for the one; doubles on it; points that stay on the torus. */
#ifndef PS_SAMPLERS_FORCES_LOAN_H
#define PS_SAMPLERS_FORCES_LOAN_H

#include "device/lender.h"
#include "samplers/sampler.h"
#include "device/device.h"

#include <math.h>

/* A device without double precision is refused, with a sentence that names the sampler. */
pspec_status ps_forces_need_doubles(const ps_device_limits *limits, const char *sampler,
                                    ps_error *error) PS_MUST_CHECK;

/* A coordinate after a move, in [0,1). */
static inline double ps_forces_wrap(double x) {
    const double wrapped = x - floor(x);
    return wrapped < 1 ? wrapped : 0;
}

typedef struct ps_loan {
    ps_device *device; /* NULL: the host makes the set */
    ps_lender *lender, *own;
} ps_loan;

/* A device with double precision; without it, or without a device, a sentence. may_be_host: the
 * host makes the set where nobody chose a device and the default one cannot, or is none. End also
 * after a failure. */
pspec_status ps_loan_begin(ps_loan *loan, const ps_sampler_request *request, bool may_be_host,
                           ps_error *error) PS_MUST_CHECK;
void ps_loan_end(ps_loan *loan);

/* Refuses beforehand, without opening it, the device that ps_loan_begin would refuse. */
pspec_status ps_loan_check(const ps_sampler_request *request, const char *selector,
                           bool may_be_host, ps_error *error) PS_MUST_CHECK;

#endif
