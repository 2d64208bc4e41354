/* pointspec devices: what OpenCL offers here, and which device would be used. */
#include "cli/command.h"
#include "cli/shown.h"
#include "commands/devices.h"

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_shown shown = {.arguments = arguments, .speaker = "pointspec devices"};
    const ps_answer_hooks hooks = ps_shown_hooks(&shown);
    ps_table_format format = PS_FORMAT_CSV;
    ps_table *table = NULL;
    if (arguments->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no file is read, but %s was given",
                       arguments->files[0]);
    }
    PS_TRY(ps_table_choose_format(&format, arguments->format, arguments->output, error));
    ps_text why_none = {0};
    pspec_status status = ps_devices_tabulate(&table, &why_none, arguments, error);
    if (status == PSPEC_OK) {
        ps_table_set_view(table, &arguments->view);
        status = ps_table_write(table, arguments->output, format, error);
    }
    if (status == PSPEC_OK && why_none.length > 0) {
        ps_answer_warn(&hooks, "%s", ps_text_string(&why_none));
    }
    ps_text_free(&why_none);
    ps_table_destroy(table);
    return status;
}

const ps_command ps_command_devices = {
    .name = "devices",
    .summary = "list OpenCL devices and what they can do",
    .usage = "devices [options]",
    .description =
        "Lists every device of every OpenCL driver. The column default is 1 for the device that "
        "the other commands would use with the same --device and POINTSPEC_DEVICE. Lanes are the "
        "native vector widths. Without a device the table is empty, and standard error says why. "
        "The last columns say whether the planner has figures measured on "
        "the "
        "device, and its peaks per second: see pointspec bench --calibrate.",
    .takes = PS_VERB_BIT(devices),
    .formats = "csv|json|npz|jsonl|text",
    .examples = {"pointspec devices", "pointspec devices --device cpu --format json"},
    .run = run,
};
