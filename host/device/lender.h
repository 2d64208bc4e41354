/* Devices that are lent to threads which make things side by side: each is opened when somebody
 * wants one and no other is idle, kept for the next, and closed with the lender.
 */
#ifndef PS_DEVICE_LENDER_H
#define PS_DEVICE_LENDER_H

#include "device/device.h"

typedef struct ps_lender ps_lender;

/* Of the device that selector means, which must stay; opens nothing. */
pspec_status ps_lender_create(ps_lender **out, const char *selector, ps_error *error) PS_MUST_CHECK;
/* Closes all devices, which must have been given back. NULL is allowed. */
void ps_lender_destroy(ps_lender *lender);

/* What it was created with. */
const char *ps_lender_selector(const ps_lender *lender);

/* A device for the caller alone, until it is given back, from any thread. Of a CPU there are as
 * many as are wanted at a time; others, where each has memory and work of its own, are waited for.
 */
pspec_status ps_lender_borrow(ps_lender *lender, ps_device **out, ps_error *error) PS_MUST_CHECK;
void ps_lender_give_back(ps_lender *lender, ps_device *device);

/* Devices that are open, lent or not. */
size_t ps_lender_num_open(ps_lender *lender);
/* As many at a time at most, on whatever device. For tests. */
void ps_lender_set_most(ps_lender *lender, size_t most);

#endif
