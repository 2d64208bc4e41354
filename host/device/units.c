/* Matrix units: which a device may have is known of NVIDIA's, and found out by trying them. */
#include "device/device_private.h"

const char *ps_units_name(ps_units units) {
    static const char *const names[] = {"none", "unknown", "emulated", "ptx"};
    return names[units];
}

void ps_units_of_capability(ps_device_limits *limits, unsigned major, unsigned minor) {
    enum { OF_HALVES = 2, OF_OTHERS = 64, LEAST_OF_UNITS = 8 };
    const bool is_half = (major >= 6 && major <= 10) && minor == 0;
    limits->double_cost = is_half ? OF_HALVES : OF_OTHERS;
    limits->units = major >= LEAST_OF_UNITS ? PS_UNITS_UNKNOWN : PS_UNITS_NONE;
}

/* *wrong begins as all ones, so that a device that does nothing is not taken to be right. */
static pspec_status probe(ps_device *device, ps_units units, unsigned precision, uint32_t *wrong) {
    enum { WARP = 32 }; /* of kernels/torus/units.h */
    const ps_range range = {.rank = 1, .global = {WARP}, .local = {WARP}};
    ps_defines defines = ps_defines_of(precision / 8, 4);
    ps_kernel *kernel = NULL;
    ps_buffer buffer = {0};
    pspec_status status = PSPEC_OK;
    *wrong = UINT32_MAX;
    ps_defines_add(&defines, "%s", ps_units_option(units));
    PS_TRY_OUT(status,
               ps_kernel_get(device, &kernel, "probe/units.cl", "probe_units", defines.text, NULL));
    PS_TRY_OUT(status, ps_buffer_upload(device, &buffer, wrong, sizeof *wrong, "a probe", NULL));
    PS_TRY_OUT(status, PS_LAUNCH(device, kernel, &range, NULL, PS_BUFFER(buffer)));
    PS_TRY_OUT(status, ps_buffer_read(device, &buffer, 0, wrong, sizeof *wrong, NULL));
out:
    ps_buffer_release(&buffer);
    return status;
}

bool ps_units_are_right(ps_device *device, ps_units units) {
    for (unsigned precision = 32; precision <= (device->limits.has_fp64 ? 64 : 32);
         precision += 32) {
        uint32_t wrong;
        if (probe(device, units, precision, &wrong) != PSPEC_OK || wrong != 0) {
            return false;
        }
    }
    return true;
}

const char *ps_units_option(ps_units units) {
    return units == PS_UNITS_PTX ? "-DUNITS=UNITS_PTX" : "-DUNITS=UNITS_EMULATED";
}

void ps_device_set_units(ps_device *device, ps_units units) {
    device->limits.units = units;
}
