/* The doctor: devices, and whether they compute what is known. */
#include "base/text.h"
#include "commands/doctor.h"
#include "device/device.h"
#include "device/drivers.h"
#include "request/option_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void ps_doctor_tell(const ps_doctor *doctor, ps_finding_kind kind, const char *topic,
                    const char *format, ...) {
    static const char *const words[] = {"ok", "note", "WRONG"};
    char sentence[PS_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    if (doctor->hooks->tell_finding != NULL) {
        doctor->hooks->tell_finding(doctor->hooks->payload, words[kind], topic, sentence);
    }
    const ps_cell cells[] = {PS_TEXT(words[kind]), PS_TEXT(topic), PS_TEXT(sentence)};
    if (doctor->unwritten->status == PSPEC_OK) {
        doctor->unwritten->status = ps_table_add_row(doctor->table, cells, doctor->unwritten);
    }
}

/* Four points at equal distances: P is 4 at multiples of 4 and 0 elsewhere. */
enum { NUM_POINTS = 4 };
static const double far_off = 1e-4; /* single precision does a hundred times better */

static bool is_right(const ps_table *table) {
    size_t bin = 0;
    size_t power = 0;
    const size_t num = ps_table_num_rows(table);
    bool is_good = num == NUM_POINTS && ps_table_find_column(table, "bin", &bin) &&
                   ps_table_find_column(table, "power", &power);
    for (size_t row = 0; row < num && is_good; row++) {
        const double known =
            ps_table_cell(table, row, bin).integer % NUM_POINTS == 0 ? NUM_POINTS : 0;
        is_good = fabs(ps_table_cell(table, row, power).number - known) < far_off;
    }
    return is_good;
}

static pspec_status ask(ps_request *out, ps_error *error) {
    static const struct {
        ps_option_id id;
        const char *value;
    } options[] = {{PS_OPTION_SAMPLER, "regular"},     {PS_OPTION_POINTS, "4"},
                   {PS_OPTION_DIMENSION, "1"},         {PS_OPTION_MAX_FREQUENCY, "4"},
                   {PS_OPTION_ENGINE, "torus_direct"}, {PS_OPTION_NO_SELF_CHECK, "true"}};
    *out = ps_request_default;
    out->command_line = "pointspec doctor";
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        PS_TRY(ps_option_apply(out, options[i].id, ps_options[options[i].id].metavar,
                               options[i].value, error));
    }
    return PSPEC_OK;
}

static pspec_status compute(const char *device, bool *is_good, ps_error *error) {
    const ps_answer_hooks nobody = {0};
    ps_answer answer = {0};
    ps_request request;
    PS_TRY(ask(&request, error));
    request.limits.device = device;
    const pspec_status status = ps_answer_make(&answer, &ps_kind_power, &request, &nobody, error);
    *is_good = status == PSPEC_OK && is_right(answer.table);
    ps_answer_free(&answer);
    return status;
}

/* Of all kernels, whatever is computed here. */
static pspec_status check_kept(ps_error *error) {
    glob_t kept;
    pspec_status status = ps_kept_list(&kept, error);
    status = status == PSPEC_OK ? ps_kept_check(&kept, NULL, error) : status;
    globfree(&kept);
    return status;
}

static void try_device(const ps_doctor *doctor, const ps_device_limits *limits, size_t index,
                       bool is_default, bool *is_good) {
    char number[24];
    ps_error reason = {0};
    const char *const which = is_default ? ", the default" : "";
    const ps_finding_kind bad = is_default ? PS_FINDING_WRONG : PS_FINDING_NOTE;
    *is_good = false;
    snprintf(number, sizeof number, "%zu", index);
    if ((ps_device_is_pocl(limits) && check_kept(&reason) != PSPEC_OK) ||
        compute(number, is_good, &reason) != PSPEC_OK) {
        ps_doctor_tell(doctor, bad, "device", "number %zu, \"%s\"%s, fails: %s", index,
                       limits->name, which, reason.message);
        return;
    }
    ps_doctor_tell(doctor, *is_good ? PS_FINDING_GOOD : bad, "device",
                   "number %zu, \"%s\"%s (%s, driver %s, %u compute units%s): a kernel builds, "
                   "and its numbers are %s",
                   index, limits->name, which, limits->platform, limits->driver,
                   limits->compute_units, ps_device_is_simulator(limits) ? ", a simulator" : "",
                   *is_good ? "right" : "wrong");
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
    for (size_t i = 0; i < num; i++) {
        bool is_good = false;
        try_device(doctor, &limits[i], i, i == chosen, &is_good);
        *is_wrong = *is_wrong || (i == chosen && !is_good);
    }
    free(limits);
    return PSPEC_OK;
}
