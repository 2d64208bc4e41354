/* Which devices a selector means: one by index, kind or a part of its name; several by a list, "0,1",
 * by "gpu:all", or as the shares of a CPU's processors, "cpu:split=2", of which "cpu:split=2/1" is
 * one, the second.
 *
 * Whoever works on one device alone takes the first that a selector means.
 */
#ifndef PS_DEVICE_CHOICE_H
#define PS_DEVICE_CHOICE_H

#include "device/device.h"

/* As many as a machine may have, and a device may be split into. */
enum { PS_SELECTORS_MOST = 64 };

/* Selectors of one device or share each. */
typedef struct ps_selectors {
    size_t num;
    struct ps_one_selector {
        char text[64]; /* "1", "0:split=2/1" */
    } of[PS_SELECTORS_MOST];
} ps_selectors;

/* May it mean more than one? NULL does not. Nothing is asked of a driver. */
bool ps_selector_is_list(const char *selector);

/* All devices that the selector means, in its order; one that is named twice is refused. */
pspec_status ps_selectors_find(ps_selectors *out, const ps_device_limits *limits,
                               size_t num_devices, const char *selector,
                               ps_error *error) PS_MUST_CHECK;

/* What ps_device_open makes of the first that a selector means. */
typedef struct ps_choice {
    size_t index;      /* in the list of devices */
    size_t num_shares; /* 0: the whole device */
    size_t share;
} ps_choice;
pspec_status ps_device_choose_share(ps_choice *out, const ps_device_limits *limits,
                                    size_t num_devices, const char *selector,
                                    ps_error *error) PS_MUST_CHECK;

#endif
