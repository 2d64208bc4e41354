/* pointspec devices: what OpenCL offers here, and which device would be used. */
#include "answers/kind.h"
#include "engines/engine.h"
#include "store/figures_file.h"

#include <stdlib.h>

static const ps_field_row own_fields[] = {
    {"device", "", PS_ENTRY, 0, "unless there is none", "name of the default device"},
    {"index", "", PS_COLUMN, 0, "", "as --device takes it"},
    {"default", "", PS_COLUMN, 0, "", "1 for the device that other commands would use, else 0"},
    {"name", "", PS_COLUMN, 0, "", "as the driver says"},
    {"type", "", PS_COLUMN, 0, "", "gpu, cpu or accelerator"},
    {"platform", "", PS_COLUMN, 0, "", "as the driver says"},
    {"driver", "", PS_COLUMN, 0, "", "its version, as it says"},
    {"opencl_version", "", PS_COLUMN, 0, "", "as the driver says"},
    {"compute_units", "", PS_COLUMN, 0, "", "as the driver says"},
    {"clock_mhz", "MHz", PS_COLUMN, 0, "", "as the driver says"},
    {"fp64", "", PS_COLUMN, 0, "", "1 when there is double precision, else 0"},
    {"float_lanes", "", PS_COLUMN, 0, "", "native width of vectors in single precision"},
    {"double_lanes", "", PS_COLUMN, 0, "", "native width of vectors in double precision"},
    {"global_bytes", "bytes", PS_COLUMN, 0, "", "memory"},
    {"max_allocation_bytes", "bytes", PS_COLUMN, 0, "", "largest buffer"},
    {"local_bytes", "bytes", PS_COLUMN, 0, "", "local memory of a work-group"},
    {"cache_bytes", "bytes", PS_COLUMN, 0, "", "cache of global memory"},
    {"figures", "", PS_COLUMN, 0, "",
     "whether the planner has figures measured on this device (bench --calibrate), or why not"},
    {"single_flops", "1/s", PS_COLUMN, 0, "", "measured peak; missing without figures"},
    {"double_flops", "1/s", PS_COLUMN, 0, "", "measured peak; missing without figures"},
    {"copied_bytes", "bytes/s", PS_COLUMN, 0, "", "measured peak; missing without figures"},
    {.name = NULL}};
static const ps_field_row *const fields[] = {ps_fields_asked, own_fields, NULL};

static const char *device_type(const ps_device_limits *limits) {
    return limits->is_gpu ? "gpu" : limits->is_cpu ? "cpu" : "accelerator";
}

/* Measured, or not known. */
static ps_cell rate(double value) {
    return value > 0 ? PS_NUMBER(value) : PS_MISSING;
}

static pspec_status add_device(ps_table *table, const ps_device_limits *limits, size_t index,
                               bool is_default, const char *folder, ps_error *error) {
    ps_figures figures;
    PS_TRY(ps_figures_read(&figures, folder, limits, error));
    const ps_cell cells[] = {
        PS_INTEGER(index),
        PS_INTEGER(is_default),
        PS_TEXT(limits->name),
        PS_TEXT(device_type(limits)),
        PS_TEXT(limits->platform),
        PS_TEXT(limits->driver),
        PS_TEXT(limits->version),
        PS_INTEGER(limits->compute_units),
        PS_INTEGER(limits->clock_mhz),
        PS_INTEGER(limits->has_fp64),
        PS_INTEGER(limits->native_float_lanes),
        PS_INTEGER(limits->native_double_lanes),
        PS_INTEGER(limits->global_bytes),
        PS_INTEGER(limits->max_allocation_bytes),
        PS_INTEGER(limits->local_bytes),
        PS_INTEGER(limits->cache_bytes),
        PS_TEXT(figures.note),
        rate(figures.flops[PS_SINGLE]),
        rate(figures.flops[PS_DOUBLE]),
        rate(figures.copied_bytes),
    };
    return ps_table_add_row(table, cells, error);
}

/* None is a list, too, and the table is empty. */
static pspec_status list_devices(ps_device_limits **limits, size_t *num_devices, ps_text *why_none,
                                 ps_error *error) {
    const pspec_status status = ps_device_list(limits, num_devices, error);
    if (status != PSPEC_ERROR_NO_DEVICE) {
        return status;
    }
    ps_text_append(why_none, "%s", error->message);
    *error = (ps_error){0};
    *num_devices = 0;
    return ps_text_check(why_none, error);
}

static pspec_status add_header(ps_table *table, const ps_request *request,
                               const ps_device_limits *chosen, ps_error *error) {
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    return ps_table_add_meta(table, "device", PS_TEXT(chosen->name), error);
}

static pspec_status fill_table(ps_table *table, ps_text *why_none, const ps_request *request,
                               ps_error *error) {
    ps_device_limits *limits = NULL;
    size_t num_devices = 0;
    size_t chosen = 0;
    pspec_status status = PSPEC_OK;
    PS_TRY(list_devices(&limits, &num_devices, why_none, error));
    if (num_devices == 0) {
        return ps_lead_add_origin(table, request->command_line, error);
    }
    PS_TRY_OUT(status,
               ps_device_choose(limits, num_devices, request->limits.device, &chosen, error));
    PS_TRY_OUT(status, add_header(table, request, &limits[chosen], error));
    for (size_t i = 0; i < num_devices; i++) {
        PS_TRY_OUT(status, add_device(table, &limits[i], i, i == chosen,
                                      request->limits.cache_folder, error));
    }
out:
    free(limits);
    return status;
}

/* An output NULL is none. */
static pspec_status run(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                        ps_error *error) {
    ps_table_format format = PS_FORMAT_CSV;
    ps_text why_none = {0};
    PS_TRY(ps_request_check_no_files(request, "", error));
    PS_TRY(ps_table_choose_format(&format, request->format, request->output, error));
    PS_TRY(ps_fields_create_table(&out->table, "devices", own_fields, error));
    ps_table_set_blocks(out->table);
    ps_table_set_view(out->table, &request->view);
    pspec_status status = fill_table(out->table, &why_none, request, error);
    if (status == PSPEC_OK && request->output != NULL) {
        status = ps_table_write(out->table, request->output, format, error);
    }
    if (status == PSPEC_OK) {
        ps_answer_warn_of(hooks, ps_text_string(&why_none));
    }
    ps_text_free(&why_none);
    return status;
}

const ps_command ps_command_devices = {
    .name = "devices",
    .purpose = "list OpenCL devices and what they can do",
    .usage = "devices [options]",
    .description =
        "Lists every device of every OpenCL driver. The column default is 1 for the device that "
        "the other commands would use with the same --device and POINTSPEC_DEVICE. Lanes are the "
        "native vector widths. Without a device the table is empty, and standard error says why. "
        "The last columns say whether the planner has figures measured on "
        "the "
        "device, and its peaks per second: see pointspec bench --calibrate.",
    .takes = PS_COMMAND_BIT(devices),
    .fields = fields,
    .has_words = true,
    .examples = {"pointspec devices", "pointspec devices --device cpu --format json"},
    .speaker = "pointspec devices",
    .run = run,
};
