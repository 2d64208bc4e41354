#include "device/kind.h"

#include "device/device_private.h"

#include <stdio.h>

static void say_what_was_probed(char *out, size_t bytes, const ps_device_limits *limits) {
    const unsigned kilobytes = (unsigned)((limits->local_bytes + 1023) / 1024);
    char cost[16] = "none";
    if (limits->has_fp64) {
        snprintf(cost, sizeof cost, "1/%u", ps_device_double_cost(limits));
    }
    snprintf(out, bytes, "gpu local=%uK group=%zu double=%s", kilobytes,
             limits->max_work_group_size, cost);
}

ps_device_kind ps_device_kind_of(const ps_device_limits *limits) {
    ps_device_kind out = {.text = "the host"};
    if (limits == NULL) {
        return out;
    }
    char what[96];
    snprintf(what, sizeof what, "vectors of %u and %u, local memory in the cache",
             limits->native_float_lanes, limits->native_double_lanes);
    if (limits->has_dedicated_local_memory) {
        say_what_was_probed(out.probed, sizeof out.probed, limits);
    }
    const bool has_units = limits->units != PS_UNITS_NONE;
    snprintf(out.text, sizeof out.text, "%s %s, %s%s%s", limits->platform, limits->driver,
             out.probed[0] != '\0' ? out.probed : what, has_units ? ", matrix units " : "",
             has_units ? ps_units_name(limits->units) : "");
    return out;
}

void ps_device_identify(ps_text *out, const ps_device_limits *limits) {
    if (limits == NULL) {
        ps_text_append(out, "no device\n");
        return;
    }
    ps_text_append(out, "%s\n%s\n%s\n%s\n%u %u\n", limits->platform, limits->name, limits->driver,
                   limits->version, limits->native_float_lanes, limits->native_double_lanes);
}

unsigned ps_device_double_cost(const ps_device_limits *limits) {
    enum { OF_DATA_CENTRES = 2 };
    return limits->double_cost > 0 ? limits->double_cost : OF_DATA_CENTRES;
}

/* CPUs: the machine on which the rates of plan/cost_model.c were measured, with layouts that serve
 * 8 units: on two units they cost 0.91 to 1.05 times what layouts for two cost (median 1.01 of
 * twelve questions, docs/developer/decisions.md), and a server of 8 is at work. GPUs: an H200,
 * whose time for work-groups of one item is that of 136 of them up to about 600 (`bench_sphere`).
 * */
ps_typical_device ps_device_typical(const ps_device_limits *limits) {
    static const ps_typical_device cpu = {2, 2600, 2, 32 << 20, 8, 1};
    static const ps_typical_device gpu = {132, 1980, 600, 40 << 20, 100, 2};
    return limits->has_dedicated_local_memory ? gpu : cpu;
}

pspec_status ps_buffer_add_twin(ps_device *device, ps_buffer *buffer, const char *what,
                                ps_error *error) {
    if (device->limits.has_unified_memory) {
        return PSPEC_OK;
    }
    if (device->uploads == NULL && ps_device_typical(&device->limits).queues > 1) {
        PS_TRY(ps_queue_create(device, &device->uploads, error));
    }
    return ps_pinned_create(device, &buffer->twin, buffer->bytes, what, error);
}
