/* pointspec convert: point files into another format, block by block. */
#include "cli/command.h"
#include "report/output_check.h"
#include "jobs/convert.h"
#include "questions/question.h"

#include <string.h>
#include <unistd.h>

static pspec_status check_words(const ps_request *arguments, ps_error *error) {
    if (arguments->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "nothing to convert: name point files (- for standard input)");
    }
    return ps_outputs_check(arguments, false, error);
}

/* A progress line would run into points that go to the same terminal. */
static ps_progress *begin_progress(const ps_request *arguments, const char *path) {
    const bool shares_terminal = strcmp(path, "-") == 0 && isatty(STDOUT_FILENO);
    return shares_terminal ? NULL : ps_progress_begin(arguments, "points");
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    const char *const output = arguments->output;
    ps_text loss = {0};
    PS_TRY(check_words(arguments, error));
    ps_progress *const progress = begin_progress(arguments, output);
    const ps_conversion conversion = {
        .paths = arguments->files,
        .num_paths = arguments->num_files,
        .options = ps_point_options_make(arguments),
        .points = arguments->points,
        .merge = arguments->merge,
        .output = output,
        .format = arguments->format,
        .columns = arguments->to_columns,
        .watch = {ps_progress_tell, progress},
    };
    const pspec_status status = ps_convert(&conversion, &loss, error);
    ps_progress_end(progress);
    if (status == PSPEC_OK && loss.length > 0 && !arguments->quiet) {
        fprintf(stderr, "pointspec convert: %s\n", ps_text_string(&loss));
    }
    ps_text_free(&loss);
    return status;
}

const ps_command ps_command_convert = {
    .name = "convert",
    .summary = "one format of point files into another",
    .usage = "convert [options] FILE... [-o OUT]",
    .description =
        "Reads point sets of the torus or of the sphere and writes them in another format, a block "
        "of points at a time, so that files may be larger than memory. Several files become sets "
        "of one output. What the format of the output cannot keep is refused, or said on standard "
        "error. Files compressed by gzip are read as they are.",
    .takes = PS_TAKER_BIT(convert),
    .formats = PS_POINT_FORMATS,
    .weights = "equal|column",
    .examples = {"pointspec sample --sampler white -n 64 -m 3 | pointspec convert - -o sets.npy",
                 "pointspec sample --sampler halton -n 8 | pointspec convert --select-points 2.. "
                 "--format csv -"},
    .run = run,
    .plan = ps_plan_table_add_convert,
};
