#include "device/kind.h"

#include <stdio.h>

ps_device_kind ps_device_kind_of(const ps_device_limits *limits) {
    ps_device_kind out;
    if (limits == NULL) {
        return (ps_device_kind){"the host"};
    }
    const bool has_units = limits->units != PS_UNITS_NONE;
    snprintf(out.text, sizeof out.text, "%s %s, vectors of %u and %u, local memory %s%s%s",
             limits->platform, limits->driver, limits->native_float_lanes,
             limits->native_double_lanes,
             limits->has_dedicated_local_memory ? "of its own" : "in the cache",
             has_units ? ", matrix units " : "", has_units ? ps_units_name(limits->units) : "");
    return out;
}

/* CPUs: the machine on which the rates of plan/cost_model.c were measured, with layouts that serve
 * 8 units: on two units they cost 0.91 to 1.05 times what layouts for two cost (median 1.01 of
 * twelve questions, docs/developer/decisions.md), and a server of 8 is at work. GPUs: a card of a
 * data centre; nothing was measured on one yet. */
ps_typical_device ps_device_typical(const ps_device_limits *limits) {
    static const ps_typical_device cpu = {2, 2600, 32 << 20, 8};
    static const ps_typical_device gpu = {100, 1500, 40 << 20, 100};
    return limits->has_dedicated_local_memory ? gpu : cpu;
}
