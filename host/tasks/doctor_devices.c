/* The doctor: devices, and whether they compute what is known. */
#include "tasks/doctor.h"
#include "base/text.h"
#include "device/device.h"
#include "device/drivers.h"

#include <math.h>
#include <pointspec/pointspec.h>
#include <stdio.h>
#include <stdlib.h>

/* Four points at equal distances: P is 4 at multiples of 4 and 0 elsewhere. */
enum { NUM_POINTS = 4 };
static const double far_off = 1e-4; /* single precision does a hundred times better */

static bool is_right(const pspec_bin *bins, size_t num_bins) {
    for (size_t i = 0; i < num_bins; i++) {
        const double known = lround(bins[i].frequency) % NUM_POINTS == 0 ? NUM_POINTS : 0;
        if (!(fabs(bins[i].power - known) < far_off)) {
            return false;
        }
    }
    return num_bins >= NUM_POINTS;
}

static pspec_status compute(pspec_context *context, bool *is_good) {
    static const double points[NUM_POINTS] = {0, 0.25, 0.5, 0.75};
    const pspec_pattern pattern = {1, NUM_POINTS, points, NULL};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    size_t num_bins = 0;
    request.dimension = 1;
    request.num_points = NUM_POINTS;
    request.max_frequency = NUM_POINTS;
    request.engine = "torus_direct";
    request.no_self_check = 1;
    pspec_status status = pspec_plan_create(&plan, context, &request);
    if (status == PSPEC_OK) {
        status = pspec_plan_run(plan, &pattern, 1);
    }
    if (status == PSPEC_OK) {
        status = pspec_spectrum_create(&spectrum, plan);
    }
    if (status == PSPEC_OK) {
        const pspec_bin *const bins = pspec_spectrum_bins(spectrum, &num_bins);
        *is_good = is_right(bins, num_bins);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    return status;
}

static pspec_status try_device(const ps_doctor *doctor, const ps_device_limits *limits,
                               size_t index, bool is_default, bool *is_good, ps_error *error) {
    char number[24];
    const char *const which = is_default ? ", the default" : "";
    pspec_context *const context = pspec_context_create();
    if (context == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for a context");
    }
    *is_good = false;
    snprintf(number, sizeof number, "%zu", index);
    pspec_status status = pspec_context_set_device(context, number);
    if (status == PSPEC_OK) {
        status = compute(context, is_good);
    }
    const ps_finding_kind bad = is_default ? PS_FINDING_WRONG : PS_FINDING_NOTE;
    if (status != PSPEC_OK) {
        ps_doctor_tell(doctor, bad, "device", "number %zu, \"%s\"%s, fails: %s", index,
                       limits->name, which, pspec_context_message(context));
    } else {
        ps_doctor_tell(doctor, *is_good ? PS_FINDING_GOOD : bad, "device",
                       "number %zu, \"%s\"%s (%s, driver %s, %u compute units%s): a kernel builds, "
                       "and its numbers are %s",
                       index, limits->name, which, limits->platform, limits->driver,
                       limits->compute_units, ps_device_is_simulator(limits) ? ", a simulator" : "",
                       *is_good ? "right" : "wrong");
    }
    pspec_context_destroy(context);
    return PSPEC_OK;
}

static pspec_status tell_drivers(const ps_doctor *doctor, ps_error *error) {
    ps_drivers drivers;
    const pspec_status status = ps_drivers_look(&drivers, error);
    if (status == PSPEC_OK && drivers.problem != NULL) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "drivers", "%s cannot be read: %s", drivers.place,
                       drivers.problem);
    } else if (status == PSPEC_OK && drivers.num == 0) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "drivers", "none is listed in %s", drivers.place);
    }
    for (size_t i = 0; i < drivers.num && status == PSPEC_OK; i++) {
        const ps_driver *const driver = &drivers.drivers[i];
        if (driver->problem == NULL) {
            ps_doctor_tell(doctor, PS_FINDING_GOOD, "drivers", "%s loads, listed in %s",
                           driver->library, driver->file);
        } else {
            ps_doctor_tell(doctor, PS_FINDING_NOTE, "drivers", "%s does not load: %s", driver->file,
                           driver->problem);
        }
    }
    if (getenv("POCL_DEVICES") != NULL) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "drivers",
                       "PoCL makes only the devices that POCL_DEVICES names: \"%s\"",
                       getenv("POCL_DEVICES"));
    }
    ps_drivers_free(&drivers);
    return status;
}

pspec_status ps_doctor_devices(const ps_doctor *doctor, bool *is_wrong, ps_error *error) {
    ps_device_limits *limits = NULL;
    size_t num = 0;
    size_t chosen = 0;
    ps_error reason = {0};
    PS_TRY(tell_drivers(doctor, error));
    pspec_status status = ps_device_list(&limits, &num, &reason);
    if (status == PSPEC_OK) {
        status = ps_device_choose(limits, num, doctor->device, &chosen, &reason);
    }
    *is_wrong = status != PSPEC_OK;
    if (*is_wrong) {
        ps_doctor_tell(doctor, PS_FINDING_WRONG, "device", "%s", reason.message);
        num = limits != NULL ? num : 0;
        chosen = num;
    }
    status = PSPEC_OK;
    for (size_t i = 0; i < num && status == PSPEC_OK; i++) {
        bool is_good = false;
        status = try_device(doctor, &limits[i], i, i == chosen, &is_good, error);
        *is_wrong = *is_wrong || (i == chosen && !is_good);
    }
    free(limits);
    return status;
}
