/* Kinds of devices. Results have the same bits on all devices of a kind, and the same engines are
 * chosen there: the driver, which compiles the kernels, the widths of its vectors, and whether
 * local memory is memory of its own; of GPUs also how much of it there is, which rows and boxes
 * must fit into, how large work-groups may be, what double precision costs; and matrix units that
 * were tried when the device was opened. How many compute units a device has, and how fast they
 * are, makes no other kind: nothing is chosen by it. */
#ifndef PS_DEVICE_KIND_H
#define PS_DEVICE_KIND_H

#include "base/text.h"
#include "device/device.h"

typedef struct ps_device_kind {
    char text[400]; /* "PLATFORM DRIVER, vectors of 16 and 8, local memory in the cache" */
    /* "gpu local=48K group=1024 double=1/2", what is asked of a GPU and decides:
     * it is in the text there, and `engine:` has it; empty on CPUs. */
    char probed[96];
} ps_device_kind;

/* limits: of an open device, NULL for the host without a device. */
ps_device_kind ps_device_kind_of(const ps_device_limits *limits);

/* Operations in single precision in the time of one in double; 2 where the driver does not say. */
unsigned ps_device_double_cost(const ps_device_limits *limits);

/* What choices take a device of its kind to have, whatever it has. */
typedef struct ps_typical_device {
    double compute_units, clock_mhz;
    double single_items; /* small work-groups, of one item on CPUs, that it works on side by side */
    double cache_bytes;  /* of the last level */
    size_t served_units; /* layouts cut work into shares for so many */
    unsigned queues;     /* 2: one copies what comes next while the other computes */
} ps_typical_device;
ps_typical_device ps_device_typical(const ps_device_limits *limits);

/* Lines of a key: the driver, and what of the device bits may depend on. NULL: there is none. */
void ps_device_identify(ps_text *out, const ps_device_limits *limits);

#endif
