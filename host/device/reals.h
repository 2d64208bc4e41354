/* Doubles of the host as numbers in working precision on the device. */
#ifndef PS_DEVICE_REALS_H
#define PS_DEVICE_REALS_H

#include "device/device.h"
#include "device/precision.h"

/* Returns the bytes that one number takes on the device. */
size_t ps_real_bytes(ps_precision precision);

/* Numbers to the beginning of a buffer; nothing is allocated. */
pspec_status ps_reals_write(ps_device *device, const ps_buffer *buffer, ps_precision precision,
                            const double *numbers, size_t num, ps_error *error) PS_MUST_CHECK;
/* Number i of an array that was read as it is. */
double ps_real_at(ps_precision precision, const void *reals, size_t i);
/* Numbers from the beginning of a buffer, as doubles. */
pspec_status ps_reals_read(ps_device *device, const ps_buffer *buffer, ps_precision precision,
                           double *numbers, size_t num, ps_error *error) PS_MUST_CHECK;
/* A buffer made of them; what names it in the message. */
pspec_status ps_reals_upload(ps_device *device, ps_buffer *out, ps_precision precision,
                             const double *numbers, size_t num, const char *what,
                             ps_error *error) PS_MUST_CHECK;

#endif
